//! Movements of the camera: orbit, pan, dolly, fly, home and frame-all.
//!
//! In: a [`Camera`], a [`DistanceField`], the picture's size, pointer positions and time steps.
//! Out: the moved camera. This module does not depend on egui and keeps no clock.
//!
//! | file | contents |
//! |---|---|
//! | `navigation.rs` | the world around the camera, and the pointer's gestures |
//! | [`collide`] | collision of the eye with the surface, and sliding along it |
//! | [`turntable`] | rotations that keep the horizon level |
//! | [`fly`] | flying by keys, at a speed that follows the distance to the surface |
//! | [`flight`] | animated flights: home, frame-all, level |
//! | `route` | collision-free routes of flights |
//!
//! Pointer positions are normalised device coordinates: −1 to 1, x right, y up. Zoom amounts are
//! natural logarithms: +1 reduces the distance by a factor of e.
//!
//! Rules of every movement:
//! - the eye never passes the surface, and stays [`World::clearance`] away from the surface;
//! - the eye comes no nearer to its target than [`World::nearest`], the limit of the renderer's
//!   precision, and goes no farther from the scene's origin than [`MAX_EYE_DISTANCE`];
//! - positions are rounded to 10⁻⁴ of a pixel at the surface's distance, so that documents have
//!   no invisible digits;
//! - no measurement uses absolute f64 coordinates: positions are exact points, and nearby positions
//!   are vectors from the field's origin, so that all zoom levels behave alike.

pub mod collide;
pub mod flight;
pub mod fly;
mod route;
pub mod turntable;

use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use crate::{
    formula::{DistanceField, Ray},
    fractal::{camera_ray, pixel_cone},
    scene::{Camera, PrecisePoint},
};
use flight::Flight;
pub use fly::FlyInput;
use fly::FlySpeed;
use turntable::Turntable;

/// Maximum distance of the eye from the scene's origin, in scene units.
pub const MAX_EYE_DISTANCE: f64 = 90.0;
/// Maximum steps of a picking ray, so that the pointer responds at once.
const PICK_STEPS: u32 = 400;
/// Minimum distance of the eye from any surface, as a fraction of [`World::nearest`].
const CLEARANCE: f64 = 0.25;
/// Maximum distance of an eye at the limit, in units of [`World::nearest`].
///
/// Above 1, because the target is farther than the nearest surface, and distances are estimates.
const AT_LIMIT: f64 = 2.0;
/// As [`AT_LIMIT`], if the pivot is at the limit.
const AT_LIMIT_OF_PIVOT: f64 = 100.0;
/// Rounding of positions, in pixels at the surface's distance.
const GRAIN_PX: f64 = 1e-4;
/// Rounding of the pivot, in view units.
const PIVOT_GRAIN: f64 = 1e-6;
/// Range of the pivot's distance during a dolly, as a fraction of the target's depth.
const PIVOT_PARTS: RangeInclusive<f64> = 0.02..=50.0;
/// Rotation for a drag over half the picture's height, in radians.
const TURN_PER_HALF_HEIGHT_RAD: f64 = std::f64::consts::FRAC_PI_2;

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
    fn ray(&self, camera: &Camera, ndc: DVec2) -> Ray {
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
    fn target(&self, camera: &Camera, ndc: DVec2) -> DVec3 {
        self.pick(camera, ndc).unwrap_or_else(|| {
            let ray = self.ray(camera, ndc);
            let min = self.field.clear_distance(ray.origin).max(self.nearest(camera));
            ray.direction
                * self.field.closest_approach(ray, f64::INFINITY).clamp(min, 2.0 * MAX_EYE_DISTANCE)
        })
    }

    fn hit_cone(&self, camera: &Camera) -> f64 {
        self.cone(camera) * self.viewport.detail
    }

    /// Rounding of positions at the camera, in scene units.
    fn grain(&self, camera: &Camera) -> f64 {
        self.grain_after(camera, DVec3::ZERO)
    }

    /// Rounding of positions after a movement by `moved`, in scene units.
    ///
    /// The grain before the movement could round the eye into the surface that stopped the eye.
    fn grain_after(&self, camera: &Camera, moved: DVec3) -> f64 {
        self.grain_at(camera, self.field.clear_distance(self.eye(camera) + moved))
    }

    /// Rounding of positions for a surface at `depth`, in scene units.
    fn grain_at(&self, camera: &Camera, depth: f64) -> f64 {
        GRAIN_PX * 2.0 * self.cone(camera) * depth.max(self.clearance(camera))
    }

    /// The picture position of the point at `offset` from the eye; none behind the eye.
    fn ndc_of(&self, camera: &Camera, offset: DVec3) -> Option<DVec2> {
        let seen = camera.rotation().inverse() * offset;
        let scale = camera.half_height(self.viewport.aspect) * -seen.z;
        (seen.z < 0.0).then(|| DVec2::new(seen.x / (scale * self.viewport.aspect), seen.y / scale))
    }
}

/// A pointer's gesture in progress.
#[derive(Clone, Debug)]
enum Gesture {
    Orbit { last: DVec2, turntable: Turntable },
    Pan { grabbed: PrecisePoint },
}

/// The state of movements between events.
#[derive(Clone, Debug, Default)]
pub struct Navigator {
    gesture: Option<Gesture>,
    fly_speed: FlySpeed,
    flight: Option<Flight>,
}

impl Navigator {
    /// True between the start and the end of a gesture, or during a flight.
    pub fn is_active(&self) -> bool {
        self.gesture.is_some() || self.flight.is_some()
    }

    /// Begins an orbit around the surface point under the pointer, which becomes the pivot.
    ///
    /// Over the background, a pivot inside the picture stays. A pivot outside the picture moves
    /// to the point of the pointer's ray closest to the surface.
    pub fn begin_orbit(&mut self, camera: &mut Camera, world: World<'_>, ndc: DVec2) {
        self.cancel();
        let pivot_in_picture = world
            .ndc_of(camera, &camera.pivot - &camera.position)
            .is_some_and(|seen| seen.abs().max_element() <= 1.0);
        let pivot = match world.pick(camera, ndc) {
            Some(picked) => Some(picked),
            None if pivot_in_picture => None,
            None => Some(world.target(camera, ndc)),
        };
        if let Some(offset) = pivot {
            camera.pivot = camera.position.moved_by(offset, world.grain(camera));
        }
        self.gesture = Some(Gesture::Orbit { last: ndc, turntable: Turntable::of(camera) });
    }

    /// Begins a pan: [`Self::drag`] keeps the grabbed surface point under the pointer.
    pub fn begin_pan(&mut self, camera: &Camera, world: World<'_>, ndc: DVec2) {
        self.cancel();
        let grabbed = camera.position.moved_by(world.target(camera, ndc), world.grain(camera));
        self.gesture = Some(Gesture::Pan { grabbed });
    }

    /// Continues the gesture with the pointer at `ndc`. Returns whether the camera changed.
    pub fn drag(&mut self, camera: &mut Camera, world: World<'_>, ndc: DVec2) -> bool {
        let before = camera.clone();
        match &mut self.gesture {
            Some(Gesture::Orbit { last, turntable }) => {
                let moved = (ndc - *last)
                    * DVec2::new(world.viewport.aspect, 1.0)
                    * TURN_PER_HALF_HEIGHT_RAD;
                *last = ndc;
                // The scene follows the pointer, so the eye moves in the opposite direction.
                turntable.orbit(camera, world, DVec2::new(-moved.x, moved.y));
            }
            Some(Gesture::Pan { grabbed }) => pan(camera, world, grabbed, ndc),
            None => {}
        }
        *camera != before
    }

    /// Ends the gesture.
    pub fn end(&mut self) {
        self.gesture = None;
    }

    /// Cancels the gesture, flying and the flight; the camera stays in place.
    pub fn cancel(&mut self) {
        self.gesture = None;
        self.flight = None;
        self.fly_speed.reset();
    }

    /// Moves the eye toward the target under the pointer, nearer by a factor of `exp(amount)`.
    ///
    /// The target keeps its place in the picture, and so does the pivot. A negative `amount` moves
    /// the eye away. During a pan (two fingers), the target is the grabbed point. Returns whether
    /// the camera changed.
    pub fn dolly(
        &mut self,
        camera: &mut Camera,
        world: World<'_>,
        ndc: DVec2,
        amount: f64,
    ) -> bool {
        self.flight = None;
        self.fly_speed.reset();
        let target = match &self.gesture {
            Some(Gesture::Pan { grabbed }) => grabbed - &camera.position,
            _ => world.target(camera, ndc),
        };
        let depth = target.length();
        if !amount.is_finite() || amount == 0.0 || !(depth > 0.0 && depth.is_finite()) {
            return false;
        }
        let wanted = depth * (-amount.clamp(-20.0, 20.0)).exp();
        let nearest = world.nearest(camera).min(depth);
        let displacement = target * ((depth - wanted.max(nearest)) / depth);
        let moved = collide::advance(world, camera, displacement);
        // The pivot's offset scales by the same factor as the target's depth.
        let new_depth = (target - moved).length();
        let grain = world.grain(camera).min(world.grain_after(camera, moved));
        let pivot_offset = (&camera.pivot - &camera.position) * (new_depth / depth);
        // A pivot much nearer or farther than the target gives a useless view unit, and would
        // exceed all limits after enough steps.
        let pivot_distance = pivot_offset
            .length()
            .clamp(PIVOT_PARTS.start() * new_depth, PIVOT_PARTS.end() * new_depth)
            .max(world.clearance(camera));
        let before = camera.clone();
        camera.position =
            camera.position.moved_by(moved, grain.min(world.grain_at(camera, new_depth)));
        let pivot_offset = pivot_offset.normalize_or(camera.forward()) * pivot_distance;
        place_pivot(camera, pivot_offset, grain);
        *camera != before
    }
}

/// Moves the camera parallel to the image plane until `grabbed` appears at `ndc`.
fn pan(camera: &mut Camera, world: World<'_>, grabbed: &PrecisePoint, ndc: DVec2) {
    let rotation = camera.rotation();
    let seen = rotation.inverse() * (grabbed - &camera.position);
    let depth = -seen.z;
    if depth <= 0.0 {
        return;
    }
    let half_height = camera.half_height(world.viewport.aspect);
    let wanted = DVec2::new(ndc.x * world.viewport.aspect, ndc.y) * half_height * depth;
    let displacement = rotation * DVec3::new(seen.x - wanted.x, seen.y - wanted.y, 0.0);
    let moved = collide::slide(world, camera, displacement);
    shift(camera, world, moved);
}

/// Moves eye and pivot together by `moved`, in scene units.
fn shift(camera: &mut Camera, world: World<'_>, moved: DVec3) {
    let grain = world.grain(camera).min(world.grain_after(camera, moved));
    let pivot_offset = &camera.pivot - &camera.position;
    camera.position = camera.position.moved_by(moved, grain);
    place_pivot(camera, pivot_offset, grain);
}

/// Places the pivot at `offset` from the eye, rounded to at most `grain`.
///
/// A pivot near the eye is rounded to [`PIVOT_GRAIN`] of its distance.
fn place_pivot(camera: &mut Camera, offset: DVec3, grain: f64) {
    camera.pivot = camera.position.moved_by(offset, grain.min(PIVOT_GRAIN * offset.length()));
}
