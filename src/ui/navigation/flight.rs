//! Eased journeys of the camera to a place it was asked to go: home, frame-all, level.
//!
//! A journey takes the way that [`super::route`] finds. Where the surface bars every way, it is a
//! cut: no journey shows the inside. The zoom changes evenly, in equal times by equal factors, but
//! for the setting off and the coming to rest; a long way takes longer.

use glam::{DQuat, DVec3};

use super::{
    FARTHEST_EYE, Navigator, World,
    route::{self, Leg, ROOM, Stop},
};
use crate::scene::Camera;

/// How long a short journey takes.
pub const FLIGHT_SECS: f64 = 0.9;
/// Fastest zoom of a long one between setting off and coming to rest: its logarithm per second.
pub const MOST_ZOOM_PER_SEC: f64 = 14.0;

/// A journey in progress.
#[derive(Clone, Debug)]
pub struct Flight {
    from: Camera,
    to: Camera,
    legs: Vec<Leg>,
    secs: f64,
    elapsed_secs: f64,
}

impl Flight {
    /// Plans the journey; none where the surface bars every way.
    fn plan(world: World<'_>, from: &Camera, to: &Camera) -> Option<Self> {
        let legs = route::plan(world, from, to)?;
        let length: f64 = legs.iter().map(|leg| leg.length).sum();
        // Setting off and coming to rest each take half of a short journey, and no more of a long
        // one; the way not covered meanwhile is made up for.
        let secs = FLIGHT_SECS.max(length / MOST_ZOOM_PER_SEC + 0.5 * FLIGHT_SECS);
        Some(Self { from: from.clone(), to: to.clone(), legs, secs, elapsed_secs: 0.0 })
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
        let Some(Stop { eye, unit, rotation }) = self.stop(eased) else {
            return self.to.clone();
        };
        let toward_pivot = |camera: &Camera| {
            let way = (&camera.pivot - &camera.position).normalize_or(camera.forward());
            camera.rotation().inverse() * way
        };
        let turn = DQuat::from_rotation_arc(toward_pivot(from), toward_pivot(to));
        let toward_pivot = DQuat::IDENTITY.slerp(turn, eased) * toward_pivot(from);
        Camera {
            pivot: eye.moved_by(rotation * toward_pivot * unit, 1e-9 * unit),
            position: eye,
            orientation: rotation.normalize().into(),
            vertical_fov_deg: mix(from.vertical_fov_deg, to.vertical_fov_deg),
            stereo: to.stereo.clone(),
        }
    }

    /// Where the journey is once this part of its length lies behind it.
    fn stop(&self, part: f64) -> Option<Stop> {
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

/// From rest to rest, at an even pace between ramps that each take `ramp` of the time, at most a
/// half.
fn ease(progress: f64, ramp: f64) -> f64 {
    let ramped = |time: f64| 0.5 * time * time / ramp;
    let pace = 1.0 / (1.0 - ramp);
    let left = 1.0 - progress;
    if progress < ramp {
        pace * ramped(progress)
    } else if left < ramp {
        1.0 - pace * ramped(left)
    } else {
        pace * (progress - 0.5 * ramp)
    }
}

impl Navigator {
    /// Sets off to `to`; at once there where the surface bars the way, or where asked again on
    /// the way there.
    pub fn fly_to(&mut self, camera: &mut Camera, world: World<'_>, to: &Camera) {
        let on_the_way = self.flight.take();
        self.cancel();
        // A journey changes where one is, not the screen that one sits before.
        let to = Camera { stereo: camera.stereo.clone(), ..to.clone() };
        if on_the_way.is_none_or(|flight| flight.to != to) {
            self.flight = Flight::plan(world, camera, &to);
        }
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
        flight.elapsed_secs += if dt_secs.is_finite() { dt_secs.max(0.0) } else { flight.secs };
        *camera = flight.camera();
        if flight.elapsed_secs >= flight.secs {
            self.flight = None;
        }
        true
    }
}
