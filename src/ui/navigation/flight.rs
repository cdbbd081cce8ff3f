//! Animated flights of the camera to a target: home, frame-all, level, a point of the surface.
//!
//! A flight follows the route of the module `route`. If the surface blocks every route, the camera
//! jumps to the target, so no flight shows the inside. The zoom changes by equal factors in equal
//! times, except for the acceleration at the start and the deceleration at the end. Long flights
//! take more time.

use glam::{DQuat, DVec3};

use super::{
    route::{self, Leg, ROOM, Waypoint},
    world::{MAX_EYE_DISTANCE, World},
};
use crate::scene::Camera;

/// Duration of a short flight.
pub const FLIGHT_SECS: f64 = 0.9;
/// Maximum zoom rate of a long flight: natural logarithm per second.
pub const MAX_ZOOM_PER_SEC: f64 = 14.0;

/// The factor by which a flight to a point divides the distance from that point.
const CLOSER: f64 = 2.5;

/// A flight in progress.
#[derive(Clone, Debug)]
pub struct Flight {
    from: Camera,
    to: Camera,
    legs: Vec<Leg>,
    secs: f64,
    elapsed_secs: f64,
}

impl Flight {
    /// Plans a flight; none if the surface blocks every route.
    pub(super) fn plan(world: World<'_>, from: &Camera, to: &Camera) -> Option<Self> {
        let legs = route::plan(world, from, to)?;
        let length: f64 = legs.iter().map(|leg| leg.length).sum();
        // Acceleration and deceleration take half of FLIGHT_SECS each, at half the speed on
        // average, so both together cost half of FLIGHT_SECS.
        let secs = FLIGHT_SECS.max(length / MAX_ZOOM_PER_SEC + 0.5 * FLIGHT_SECS);
        Some(Self { from: from.clone(), to: to.clone(), legs, secs, elapsed_secs: 0.0 })
    }

    /// True if the flight ends at `camera`.
    pub(super) fn leads_to(&self, camera: &Camera) -> bool {
        self.to == *camera
    }

    /// Continues the flight by `dt_secs` and returns the camera.
    pub(super) fn advance(&mut self, dt_secs: f64) -> Camera {
        self.elapsed_secs += if dt_secs.is_finite() { dt_secs.max(0.0) } else { self.secs };
        self.camera()
    }

    /// True at the target.
    pub(super) fn is_over(&self) -> bool {
        self.elapsed_secs >= self.secs
    }

    /// The camera after `elapsed_secs`.
    fn camera(&self) -> Camera {
        let progress = self.elapsed_secs / self.secs;
        if progress >= 1.0 {
            return self.to.clone();
        }
        let (from, to) = (&self.from, &self.to);
        let eased = ease(progress, 0.5 * FLIGHT_SECS / self.secs);
        let mix = |a: f64, b: f64| a + (b - a) * eased;
        let Some(Waypoint { eye, unit, rotation }) = self.waypoint(eased) else {
            return self.to.clone();
        };
        let toward_pivot = |camera: &Camera| {
            let direction = (&camera.pivot - &camera.position).normalize_or(camera.forward());
            camera.rotation().inverse() * direction
        };
        let turn = DQuat::from_rotation_arc(toward_pivot(from), toward_pivot(to));
        let toward_pivot = DQuat::IDENTITY.slerp(turn, eased) * toward_pivot(from);
        Camera {
            pivot: eye.moved_by(rotation * toward_pivot * unit, 1e-9 * unit),
            position: eye,
            orientation: rotation.normalize().into(),
            vertical_fov_deg: mix(from.vertical_fov_deg, to.vertical_fov_deg),
            lens: to.lens.clone(),
            stereo: to.stereo.clone(),
        }
    }

    /// The waypoint at the fraction `part` of the flight's length.
    fn waypoint(&self, part: f64) -> Option<Waypoint> {
        let length: f64 = self.legs.iter().map(|leg| leg.length).sum();
        let mut left = part * length;
        for leg in &self.legs {
            if left < leg.length {
                return Some(leg.at(left / leg.length));
            }
            left -= leg.length;
        }
        self.legs.last().map(|leg| leg.at(1.0))
    }
}

/// Easing with constant speed between two ramps, each of the duration `ramp`, at most 0.5.
fn ease(progress: f64, ramp: f64) -> f64 {
    let ramped = |time: f64| 0.5 * time * time / ramp;
    let speed = 1.0 / (1.0 - ramp);
    let left = 1.0 - progress;
    if progress < ramp {
        speed * ramped(progress)
    } else if left < ramp {
        1.0 - speed * ramped(left)
    } else {
        speed * (progress - 0.5 * ramp)
    }
}

/// The camera for which the bounding sphere fits the picture, with the direction of `camera`.
pub fn framing_all(camera: &Camera, world: World<'_>) -> Camera {
    let half_angle = camera.half_height(1.0).atan();
    let radius = world.field.bounding_radius();
    // From a deep view, the centre equals the scene's origin except for rounding.
    let centre = world.field.origin().moved_by(world.field.center(), 1e-9 * radius);
    let depth = (radius * ROOM / half_angle.sin()).min(MAX_EYE_DISTANCE);
    Camera {
        position: centre.moved_by(camera.forward() * -depth, 0.0),
        pivot: centre,
        ..camera.clone()
    }
}

/// `camera`, for which the set looks as large as one of the bounding radius `before` did.
pub fn framing_alike(camera: &Camera, world: World<'_>, before: f64) -> Camera {
    let radius = world.field.bounding_radius();
    let (eye, scale) = (world.eye(camera), radius / before);
    if !(scale.is_finite() && scale > 0.0) {
        return camera.clone();
    }
    let moved = |offset: DVec3| (world.field.center() - offset) * (1.0 - scale);
    let pivot = world.field.local(&camera.pivot);
    if (eye + moved(eye)).length() > MAX_EYE_DISTANCE {
        return camera.clone();
    }
    Camera {
        position: camera.position.moved_by(moved(eye), 1e-6 * radius),
        pivot: camera.pivot.moved_by(moved(pivot), 1e-6 * radius),
        ..camera.clone()
    }
}

/// `camera`, closer to the surface at `offset` from the eye, and turned toward it.
///
/// The eye stays on the ray to the surface, on which nothing is in its way.
pub(super) fn approaching(camera: &Camera, world: World<'_>, offset: DVec3) -> Camera {
    let depth = offset.length();
    let left = (depth / CLOSER).max(world.nearest(camera)).min(depth);
    let direction = offset / depth;
    let grain = world.grain_at(camera, left);
    let up = camera.rotation() * DVec3::Y;
    Camera {
        position: camera.position.moved_by(direction * (depth - left), grain),
        pivot: camera.position.moved_by(offset, grain),
        orientation: Camera::looking_at(DVec3::ZERO, direction, up).orientation,
        ..camera.clone()
    }
}

/// `camera`, turned upright in place.
pub(super) fn upright(camera: &Camera) -> Camera {
    let upright = Camera::looking_at(DVec3::ZERO, camera.forward(), DVec3::Z);
    Camera { orientation: upright.orientation, ..camera.clone() }
}
