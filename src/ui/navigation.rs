//! Moving the camera: orbit, pan, dolly, fly, home and frame-all.
//!
//! In: a [`Camera`], what surrounds it (a [`DistanceField`] and the picture's shape), pointer
//! positions and time steps. Out: the same camera, moved. Nothing here knows egui, and nothing
//! moves unless a method is called.
//!
//! | file | what lives there |
//! |---|---|
//! | this one | the surroundings, and the pointer's gestures |
//! | [`collide`] | how far the eye may go, and how it slides along what stops it |
//! | [`turn`] | rotations that keep the horizon |
//! | [`fly`] | travel by keys, at a speed that follows the distance to the surface |
//! | [`flight`] | eased journeys: home, frame-all, level |
//! | `route` | the ways they take |
//!
//! Pointer positions are normalised device coordinates: −1 to 1, x right, y up. Amounts of
//! zoom are natural logarithms: +1 comes nearer by a factor of e.
//!
//! The rules that hold for every movement:
//! - the eye never passes the surface, and stays [`World::clearance`] away from it;
//! - it comes no nearer to what it looks at than [`World::nearest`], where pictures still hold,
//!   and goes no farther from the scene's origin than [`FARTHEST_EYE`];
//! - positions are rounded to 10⁻⁴ of a pixel at the distance of the surface, so that a scene
//!   says no more than can be seen;
//! - nothing is measured in absolute f64 coordinates: places are exact points, and what is near
//!   them is a vector from the field's own origin, so that every scale feels the same.

pub mod collide;
pub mod flight;
pub mod fly;
mod route;
pub mod turn;

use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use crate::{
    fractal::{DistanceField, Ray, camera_ray, pixel_cone},
    scene::{Camera, PrecisePoint},
};
use flight::Flight;
pub use fly::FlyInput;
use fly::FlySpeed;
use turn::Turntable;

/// The farthest that the eye goes from the scene's origin, in scene units.
pub const FARTHEST_EYE: f64 = 90.0;
/// Most steps of a ray that looks for what is under the pointer: a hand does not wait for more.
const PICK_STEPS: u32 = 400;
/// What the eye keeps from any surface, in parts of [`World::nearest`].
const CLEARANCE: f64 = 0.25;
/// Nearest distances within which the eye is said to be at the limit: what it looks at is farther
/// than what is nearest, and the estimate is one.
const AT_LIMIT: f64 = 2.0;
/// The same where the pivot itself is at the limit.
const FAR_OFF: f64 = 100.0;
/// The coarseness of positions, in pixels at the surface's distance.
const GRAIN_PX: f64 = 1e-4;
/// The same for the pivot, in view units.
const PIVOT_GRAIN: f64 = 1e-6;
/// How near and far the pivot is while something is approached, in parts of its depth.
const PIVOT_PARTS: RangeInclusive<f64> = 0.02..=50.0;
/// How far a drag over half the picture's height turns, in radians.
const TURN_PER_HALF_HEIGHT_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// The picture's shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Width over height.
    pub aspect: f64,
    /// Height in pixels.
    pub height_px: f64,
    /// Hit distance in cone radii of a pixel: the scene's `quality.detail`.
    pub detail: f64,
}

/// What surrounds the camera.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The surface.
    pub field: &'a dyn DistanceField,
    /// The picture through which it is seen.
    pub viewport: Viewport,
}

/// Distance and precision at a camera, for the status line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraStatus {
    /// Estimated distance from the eye to the nearest surface, in scene units.
    pub distance: f64,
    /// Radius of a pixel's cone at that distance, in scene units.
    pub footprint: f64,
    /// True where coming nearer would show rounding instead of detail.
    pub at_precision_limit: bool,
}

impl World<'_> {
    /// Where the eye is, in the field's coordinates.
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

    /// The least depth of a point that the camera looks at, in scene units.
    pub fn nearest(&self, camera: &Camera) -> f64 {
        self.field.finest_footprint() / self.cone(camera)
    }

    /// The least distance between eye and surface, in scene units.
    pub fn clearance(&self, camera: &Camera) -> f64 {
        CLEARANCE * self.nearest(camera)
    }

    /// Status of `camera`.
    pub fn camera_status(&self, camera: &Camera) -> CameraStatus {
        let distance = self.field.clear_distance(self.eye(camera));
        let nearest = self.nearest(camera);
        // At low powers the estimate is often many times too large.
        let pivot_at_limit = camera.view_unit() <= nearest && distance <= FAR_OFF * nearest;
        CameraStatus {
            distance,
            footprint: distance * self.cone(camera),
            at_precision_limit: distance <= AT_LIMIT * nearest || pivot_at_limit,
        }
    }

    /// The vector from the eye to the surface seen at `ndc`; none over the background.
    pub fn pick(&self, camera: &Camera, ndc: DVec2) -> Option<DVec3> {
        let ray = self.ray(camera, ndc);
        let found = self.field.trace(ray, self.hit_cone(camera), f64::INFINITY, PICK_STEPS);
        // What a ray creeps along for so long is as good as hit.
        let depth = found.unwrap_or_else(Some)?;
        Some(ray.direction * depth.max(self.nearest(camera)))
    }

    /// The vector from the eye to what `ndc` points at: the surface or, over the background,
    /// the place on that ray that comes closest to it. Never zero.
    fn target(&self, camera: &Camera, ndc: DVec2) -> DVec3 {
        self.pick(camera, ndc).unwrap_or_else(|| {
            let ray = self.ray(camera, ndc);
            let least = self.field.clear_distance(ray.origin).max(self.nearest(camera));
            ray.direction
                * self.field.closest_approach(ray, f64::INFINITY).clamp(least, 2.0 * FARTHEST_EYE)
        })
    }

    fn hit_cone(&self, camera: &Camera) -> f64 {
        self.cone(camera) * self.viewport.detail
    }

    /// How coarse positions may be here, in scene units.
    fn grain(&self, camera: &Camera) -> f64 {
        self.grain_after(camera, DVec3::ZERO)
    }

    /// The same once the eye has gone `moved` from here: coarser, it could round it into the
    /// surface that stopped it.
    fn grain_after(&self, camera: &Camera, moved: DVec3) -> f64 {
        self.grain_at(camera, self.field.clear_distance(self.eye(camera) + moved))
    }

    /// How coarse positions may be for a picture of what is `depth` away.
    fn grain_at(&self, camera: &Camera, depth: f64) -> f64 {
        GRAIN_PX * 2.0 * self.cone(camera) * depth.max(self.clearance(camera))
    }

    /// Where in the picture the point at `offset` from the eye appears; none behind the eye.
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
    Pan { held: PrecisePoint },
}

/// The state that movements carry from one event to the next.
#[derive(Clone, Debug, Default)]
pub struct Navigator {
    gesture: Option<Gesture>,
    fly_speed: FlySpeed,
    flight: Option<Flight>,
}

impl Navigator {
    /// True between the begin and the end of a gesture, or during a flight.
    pub fn is_active(&self) -> bool {
        self.gesture.is_some() || self.flight.is_some()
    }

    /// Begins turning about the surface under the pointer, which becomes the pivot. Over the
    /// background the pivot stays where it is if it is in the picture; otherwise it moves to
    /// where the pointer's ray comes closest to the surface.
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

    /// Begins dragging the surface under the pointer, which [`Self::drag`] then keeps there.
    pub fn begin_pan(&mut self, camera: &Camera, world: World<'_>, ndc: DVec2) {
        self.cancel();
        let held = camera.position.moved_by(world.target(camera, ndc), world.grain(camera));
        self.gesture = Some(Gesture::Pan { held });
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
                // The scene follows the pointer, so the eye goes the other way.
                turntable.orbit(camera, world, DVec2::new(-moved.x, moved.y));
            }
            Some(Gesture::Pan { held }) => pan(camera, world, held, ndc),
            None => {}
        }
        *camera != before
    }

    /// Ends the gesture.
    pub fn end(&mut self) {
        self.gesture = None;
    }

    /// Stops whatever is in progress, a flight included; the camera stays where it is.
    pub fn cancel(&mut self) {
        self.gesture = None;
        self.flight = None;
        self.fly_speed.rest();
    }

    /// Comes nearer to what is under the pointer by a factor of `exp(amount)`, or recedes from it
    /// where `amount` is negative, along the pointer's ray: what is under the pointer stays there.
    /// During a pan (two fingers) it is the held point that is approached. The pivot keeps its
    /// place in the picture. Returns whether the camera changed.
    pub fn dolly(
        &mut self,
        camera: &mut Camera,
        world: World<'_>,
        ndc: DVec2,
        amount: f64,
    ) -> bool {
        self.flight = None;
        self.fly_speed.rest();
        let target = match &self.gesture {
            Some(Gesture::Pan { held }) => held - &camera.position,
            _ => world.target(camera, ndc),
        };
        let depth = target.length();
        if !amount.is_finite() || amount == 0.0 || !(depth > 0.0 && depth.is_finite()) {
            return false;
        }
        let wanted = depth * (-amount.clamp(-20.0, 20.0)).exp();
        let nearest = world.nearest(camera).min(depth);
        let way = target * ((depth - wanted.max(nearest)) / depth);
        let moved = collide::advance(world, camera, way);
        // All else scales about the target as the eye's own distance does.
        let left = (target - moved).length();
        let grain = world.grain(camera).min(world.grain_after(camera, moved));
        let pivot_offset = (&camera.pivot - &camera.position) * (left / depth);
        // A pivot far nearer or farther than what is approached says nothing of the view, and
        // would go past every limit.
        let pivot_distance = pivot_offset
            .length()
            .clamp(PIVOT_PARTS.start() * left, PIVOT_PARTS.end() * left)
            .max(world.clearance(camera));
        let before = camera.clone();
        camera.position = camera.position.moved_by(moved, grain.min(world.grain_at(camera, left)));
        let pivot_offset = pivot_offset.normalize_or(camera.forward()) * pivot_distance;
        place_pivot(camera, pivot_offset, grain);
        *camera != before
    }
}

/// Moves the camera in its own plane until `held` appears at `ndc`.
fn pan(camera: &mut Camera, world: World<'_>, held: &PrecisePoint, ndc: DVec2) {
    let rotation = camera.rotation();
    let seen = rotation.inverse() * (held - &camera.position);
    let depth = -seen.z;
    if depth <= 0.0 {
        return;
    }
    let half_height = camera.half_height(world.viewport.aspect);
    let wanted = DVec2::new(ndc.x * world.viewport.aspect, ndc.y) * half_height * depth;
    let way = rotation * DVec3::new(seen.x - wanted.x, seen.y - wanted.y, 0.0);
    let moved = collide::slide(world, camera, way);
    shift(camera, world, moved);
}

/// Moves eye and pivot together by `moved`, in scene units.
fn shift(camera: &mut Camera, world: World<'_>, moved: DVec3) {
    let grain = world.grain(camera).min(world.grain_after(camera, moved));
    let pivot_offset = &camera.pivot - &camera.position;
    camera.position = camera.position.moved_by(moved, grain);
    place_pivot(camera, pivot_offset, grain);
}

/// Puts the pivot at `offset` from the eye, rounded to `grain`, and finer where it is very near.
fn place_pivot(camera: &mut Camera, offset: DVec3, grain: f64) {
    camera.pivot = camera.position.moved_by(offset, grain.min(PIVOT_GRAIN * offset.length()));
}
