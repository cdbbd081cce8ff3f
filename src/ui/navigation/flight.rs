//! Eased journeys of the camera to a place it was asked to go: home, frame-all, level.
//!
//! A journey goes straight where that is free. Otherwise it backs out along the ray from the
//! origin through the eye, turns about the origin outside the bounding sphere, and comes in the
//! same way. Where the surface bars that too, it is a cut: no journey shows the inside.

use glam::DVec3;

use super::{FARTHEST_EYE, Navigator, World, collide};
use crate::scene::{Camera, PrecisePoint};

/// How long a journey takes.
pub const FLIGHT_SECS: f64 = 0.9;
/// Straight pieces that a route is tried in.
const TRIED_PIECES: u32 = 48;
/// Room around the bounding sphere in frame-all, and for turning about the origin.
const ROOM: f64 = 1.04;

/// The way from one eye to another.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Route {
    /// A line; the logarithm of how much larger the surroundings are at its end.
    Straight { growth: f64 },
    /// Out from the origin to this radius, around, and in again.
    Around { radius: f64 },
}

/// A journey in progress.
#[derive(Clone, Debug)]
pub struct Flight {
    from: Camera,
    to: Camera,
    route: Route,
    /// The field's origin and the bounding sphere's centre about it, from which the route is drawn.
    origin: PrecisePoint,
    center: DVec3,
    elapsed_secs: f64,
}

impl Flight {
    /// Plans the journey; none where the surface bars every route.
    fn plan(world: World<'_>, from: &Camera, to: &Camera) -> Option<Self> {
        let (start, end) = (world.eye(from), world.eye(to));
        let (origin, center) = (world.field.origin(), world.field.center());
        let room = |eye: DVec3| world.field.clear_distance(eye).max(world.clearance(from));
        let straight = Route::Straight { growth: (room(end) / room(start)).ln() };
        let outside = world.field.bounding_radius() * ROOM;
        let from_center = |eye: DVec3| eye.distance(center);
        let around =
            Route::Around { radius: from_center(start).max(from_center(end)).max(outside) };
        let clearance = world.clearance(from).min(0.5 * room(start)).min(0.5 * room(end));
        let is_free = |route: &Route| {
            let places = (0..=TRIED_PIECES)
                .map(|i| route.at([start, end], center, f64::from(i) / f64::from(TRIED_PIECES)));
            let places: Vec<_> = places.collect();
            places.windows(2).all(|pair| collide::is_free(world.field, pair[0], pair[1], clearance))
        };
        let route = [straight, around].into_iter().find(is_free)?;
        Some(Self { from: from.clone(), to: to.clone(), route, origin, center, elapsed_secs: 0.0 })
    }

    /// The camera after `elapsed_secs`.
    fn camera(&self) -> Camera {
        let progress = (self.elapsed_secs / FLIGHT_SECS).clamp(0.0, 1.0);
        if progress >= 1.0 {
            return self.to.clone();
        }
        let (from, to) = (&self.from, &self.to);
        let eased = ease(progress);
        let mix = |a: f64, b: f64| a + (b - a) * eased;
        let local = |point: &PrecisePoint| point - &self.origin;
        let ends = [&from.position, &to.position].map(local);
        let eye = self.route.at(ends, self.center, progress);
        let pivot = local(&from.pivot).lerp(local(&to.pivot), eased);
        Camera {
            position: self.origin.moved_by(eye, 0.0),
            pivot: self.origin.moved_by(pivot, 0.0),
            orientation: from.rotation().slerp(to.rotation(), eased).into(),
            vertical_fov_deg: mix(from.vertical_fov_deg, to.vertical_fov_deg),
            stereo: to.stereo.clone(),
        }
    }
}

impl Route {
    /// The eye at `progress`, 0 to 1.
    fn at(self, [start, end]: [DVec3; 2], center: DVec3, progress: f64) -> DVec3 {
        match self {
            Self::Straight { growth } => start.lerp(end, geometric(ease(progress), growth)),
            Self::Around { radius } => {
                // Out in the first third, around in the second, in during the last.
                let third = |i: f64| ease((3.0 * progress - i).clamp(0.0, 1.0));
                let (out, around, back) = (third(0.0), third(1.0), third(2.0));
                let (start, end) = (start - center, end - center);
                let (near, far) = (start.length(), end.length());
                let length = near * (radius / near.max(1e-9)).powf(out) * (far / radius).powf(back);
                let (from, to) = (start.normalize_or(DVec3::Z), end.normalize_or(DVec3::Z));
                center + from.slerp(to, around) * length
            }
        }
    }
}

/// Smoothstep: from rest to rest.
fn ease(progress: f64) -> f64 {
    progress * progress * (3.0 - 2.0 * progress)
}

/// The part of a line covered at `progress` if each step is as large as the surroundings, which
/// grow by `exp(growth)` along it.
fn geometric(progress: f64, growth: f64) -> f64 {
    if growth.abs() < 1e-3 { progress } else { (growth * progress).exp_m1() / growth.exp_m1() }
}

impl Navigator {
    /// Sets off to `to`; at once there where the surface bars the way.
    pub fn fly_to(&mut self, camera: &mut Camera, world: World<'_>, to: &Camera) {
        self.cancel();
        // A journey changes where one is, not the screen that one sits before.
        let to = Camera { stereo: camera.stereo.clone(), ..to.clone() };
        self.flight = Flight::plan(world, camera, &to);
        if self.flight.is_none() {
            *camera = to;
        }
    }

    /// Sets off to where the whole bounding sphere fits the picture, in the present direction.
    pub fn frame_all(&mut self, camera: &mut Camera, world: World<'_>) {
        let half_angle = camera.half_height(1.0).atan();
        let radius = world.field.bounding_radius();
        // Where that is the scene's origin, seen from a deep place, it is so but for rounding.
        let centre = world.field.origin().moved_by(world.field.center(), 1e-9 * radius);
        let depth = (radius * ROOM / half_angle.sin()).min(FARTHEST_EYE);
        let to = Camera {
            position: centre.moved_by(camera.forward() * -depth, 0.0),
            pivot: centre,
            ..camera.clone()
        };
        self.fly_to(camera, world, &to);
    }

    /// Turns a rolled camera upright where it stands.
    pub fn level(&mut self, camera: &mut Camera, world: World<'_>) {
        let upright = Camera::looking_at(DVec3::ZERO, camera.forward(), DVec3::Z);
        let to = Camera { orientation: upright.orientation, ..camera.clone() };
        self.fly_to(camera, world, &to);
    }

    /// Continues a flight by `dt_secs`. Returns whether one was in progress: call it once a frame
    /// until it says no.
    pub fn advance(&mut self, camera: &mut Camera, dt_secs: f64) -> bool {
        let Some(flight) = &mut self.flight else { return false };
        flight.elapsed_secs += if dt_secs.is_finite() { dt_secs.max(0.0) } else { FLIGHT_SECS };
        *camera = flight.camera();
        if flight.elapsed_secs >= FLIGHT_SECS {
            self.flight = None;
        }
        true
    }
}
