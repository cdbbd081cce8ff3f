//! The surface around the camera, measured for movements.
//!
//! In: a [`DistanceField`], the viewport and a camera. Out: picked points, the limits of movements
//! and the rounding of positions. This module moves no camera.

use glam::{DVec2, DVec3};

use crate::{
    formula::{DistanceField, Ray},
    fractal::{camera_ray, ndc_of, pixel_cone},
    scene::Camera,
};

/// Maximum distance of the eye from the scene's origin, in scene units.
pub const MAX_EYE_DISTANCE: f64 = 90.0;
/// Maximum steps of a picking ray, so that the pointer responds at once.
const PICK_STEPS: u32 = 400;
/// Maximum steps of a short ray, of which a search has many.
const SHORT_STEPS: u32 = 128;
/// Distance of a short ray's end that counts as a hit, in hit distances.
const NEAR_HIT: f64 = 4.0;
/// Minimum distance of the eye from any surface, as a fraction of [`World::nearest`].
const CLEARANCE: f64 = 0.25;
/// Maximum distance of an eye at the limit, in units of [`World::nearest`].
///
/// Above 1, because the target is farther than the nearest surface, and distances are estimates.
const AT_LIMIT: f64 = 2.0;
/// As [`AT_LIMIT`], if the pivot is at the limit.
const AT_LIMIT_OF_PIVOT: f64 = 100.0;
/// Maximum distance of a pivot on the surface from what is seen there, as a fraction of its depth.
const ON_SURFACE: f64 = 0.2;
/// Part of the bounding sphere that is in a picture of the whole set: the set itself is smaller.
const WHOLE_PART: f64 = 0.8;
/// Distance of an eye from the set's centre, in bounding radii, from which on it is outside.
const OUTSIDE: f64 = 1.25;
/// Rounding of positions, in pixels at the surface's distance.
const GRAIN_PX: f64 = 1e-4;

/// The picture's aspect, height and hit distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Width over height.
    pub aspect: f64,
    /// Height in pixels.
    pub height_px: f64,
    /// Hit distance in cone radii of a pixel: the scene's `quality.detail`.
    pub detail: f64,
}

/// The surface around the camera, and the viewport.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The surface's distance field.
    pub field: &'a dyn DistanceField,
    /// The picture's aspect, height and hit distance.
    pub viewport: Viewport,
}

/// The camera's distance to the surface and its precision, for the status line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraStatus {
    /// Estimated distance from the eye to the nearest surface, in scene units.
    pub distance: f64,
    /// Radius of a pixel's cone at the estimated distance, in scene units.
    pub footprint: f64,
    /// True if a nearer eye would show rounding errors instead of detail.
    pub at_precision_limit: bool,
    /// Radius of the fractal's bounding sphere, in scene units.
    pub bounding_radius: f64,
    /// True if the last zoom found no surface in the picture to come nearer to.
    pub nothing_ahead: bool,
    /// True if the eye is well outside of the set, as in a picture of the whole.
    pub is_outside: bool,
}

impl World<'_> {
    /// The eye's position, in the field's coordinates.
    pub fn eye(&self, camera: &Camera) -> DVec3 {
        self.field.local(&camera.position)
    }

    /// The radius of a pixel's cone per unit of depth.
    fn cone(&self, camera: &Camera) -> f64 {
        pixel_cone(camera, self.viewport.aspect, self.viewport.height_px)
    }

    /// The ray through `ndc`, in the field's coordinates.
    pub(super) fn ray(&self, camera: &Camera, ndc: DVec2) -> Ray {
        camera_ray(camera, &self.field.origin(), ndc, self.viewport.aspect)
    }

    /// Minimum depth of a point that the camera looks at, in scene units.
    pub fn nearest(&self, camera: &Camera) -> f64 {
        self.field.finest_footprint() / self.cone(camera)
    }

    /// Minimum distance between eye and surface, in scene units.
    pub fn clearance(&self, camera: &Camera) -> f64 {
        CLEARANCE * self.nearest(camera)
    }

    /// The distance and precision of `camera`.
    pub fn camera_status(&self, camera: &Camera) -> CameraStatus {
        let distance = self.field.clear_distance(self.eye(camera));
        let nearest = self.nearest(camera);
        // At low powers, the distance estimate is often many times too large.
        let pivot_at_limit =
            camera.view_unit() <= nearest && distance <= AT_LIMIT_OF_PIVOT * nearest;
        CameraStatus {
            distance,
            footprint: distance * self.cone(camera),
            at_precision_limit: distance <= AT_LIMIT * nearest || pivot_at_limit,
            bounding_radius: self.field.bounding_radius(),
            nothing_ahead: false,
            is_outside: self.is_outside(camera),
        }
    }

    /// The vector from the eye to the surface at `ndc`; none for the background.
    pub fn pick(&self, camera: &Camera, ndc: DVec2) -> Option<DVec3> {
        let ray = self.ray(camera, ndc);
        let result = self.field.trace(ray, self.hit_cone(camera), f64::INFINITY, PICK_STEPS);
        // A ray that runs out of steps is close to the surface, so its end counts as a hit.
        let depth = result.unwrap_or_else(Some)?;
        Some(ray.direction * depth.max(self.nearest(camera)))
    }

    /// The vector from the eye to the target at `ndc`; never zero.
    ///
    /// The target is the surface or, for the background, the ray's point closest to the surface.
    pub(super) fn target(&self, camera: &Camera, ndc: DVec2) -> DVec3 {
        self.pick(camera, ndc).unwrap_or_else(|| {
            let ray = self.ray(camera, ndc);
            let min = self.field.clear_distance(ray.origin).max(self.nearest(camera));
            let depth = self.closest_approach(camera, ray);
            // An estimate inside of a large sphere may be above the maximum.
            ray.direction * depth.max(min).min(2.0 * MAX_EYE_DISTANCE)
        })
    }

    /// The depth at which a ray of the camera comes closest to the surface.
    pub(super) fn closest_approach(&self, camera: &Camera, ray: Ray) -> f64 {
        self.field.closest_approach(ray, self.hit_cone(camera), SHORT_STEPS)
    }

    /// The surface at `ndc`, as [`Self::pick`], by a short ray.
    ///
    /// None also if the ray runs out of steps far from the surface.
    pub(super) fn glance(&self, camera: &Camera, ndc: DVec2) -> Option<DVec3> {
        let (ray, cone) = (self.ray(camera, ndc), self.hit_cone(camera));
        let depth = match self.field.trace(ray, cone, f64::INFINITY, SHORT_STEPS) {
            Ok(hit) => hit?,
            Err(depth) => Some(depth)
                .filter(|&depth| self.field.distance(ray.at(depth)) <= NEAR_HIT * cone * depth)?,
        };
        Some(ray.direction * depth.max(self.nearest(camera)))
    }

    fn hit_cone(&self, camera: &Camera) -> f64 {
        self.cone(camera) * self.viewport.detail
    }

    /// Rounding of positions at the camera, in scene units.
    pub(super) fn grain(&self, camera: &Camera) -> f64 {
        self.grain_after(camera, DVec3::ZERO)
    }

    /// Rounding of positions after a movement by `moved`, in scene units.
    ///
    /// The grain before the movement could round the eye into the surface that stopped the eye.
    pub(super) fn grain_after(&self, camera: &Camera, moved: DVec3) -> f64 {
        self.grain_at(camera, self.field.clear_distance(self.eye(camera) + moved))
    }

    /// Rounding of positions for a surface at `depth`, in scene units.
    pub(super) fn grain_at(&self, camera: &Camera, depth: f64) -> f64 {
        GRAIN_PX * 2.0 * self.cone(camera) * depth.max(self.clearance(camera))
    }

    /// True if a visible surface is at about `offset` from the eye.
    pub(super) fn is_surface_in_picture(&self, camera: &Camera, offset: DVec3) -> bool {
        let seen = self.ndc_of(camera, offset).filter(|seen| seen.abs().max_element() <= 1.0);
        let surface = seen.and_then(|seen| self.pick(camera, seen));
        surface.is_some_and(|surface| surface.distance(offset) <= ON_SURFACE * surface.length())
    }

    /// True if the eye is well outside of the set's bounding sphere.
    fn is_outside(&self, camera: &Camera) -> bool {
        let distance = (self.field.center() - self.eye(camera)).length();
        distance > OUTSIDE * self.field.bounding_radius()
    }

    /// True if the set as a whole, but for little of it, is in the picture.
    pub fn shows_whole(&self, camera: &Camera) -> bool {
        let centre = camera.rotation().inverse() * (self.field.center() - self.eye(camera));
        let half_height = camera.half_height(self.viewport.aspect);
        let half_size = DVec2::new(half_height * self.viewport.aspect, half_height);
        // Distance from the centre to the planes through the eye and the picture's edges.
        let room = (half_size * -centre.z - centre.truncate().abs())
            / (half_size * half_size + 1.0).map(f64::sqrt);
        room.min_element() >= WHOLE_PART * self.field.bounding_radius()
    }

    /// The picture position of the point at `offset` from the eye; none behind the eye.
    pub(super) fn ndc_of(&self, camera: &Camera, offset: DVec3) -> Option<DVec2> {
        ndc_of(camera, offset, self.viewport.aspect)
    }
}
