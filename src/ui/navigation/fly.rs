//! Travel by keys.
//!
//! The speed is a fixed part of the distance to the surface per second. That distance is
//! followed in its logarithm, with a time constant and a greatest rate: a hole that opens beside
//! the eye lets it speed up over a second or so instead of at once, a wall slows it down sooner,
//! and a floor at the nearest allowed distance keeps it from ever standing still.

use glam::{DQuat, DVec2, DVec3};

use super::{Navigator, World, collide, shift, turn::Turntable};
use crate::scene::Camera;

/// Speed in distances to the surface per second.
const SPEED_PER_SEC: f64 = 1.2;
/// What the fast key multiplies the speed by.
const FASTER: f64 = 4.0;
/// Roll while its key is down.
const ROLL_RAD_PER_SEC: f64 = 0.9;
/// Time in which the speed makes up two thirds of a change of distance.
const TIME_CONSTANT_SECS: f64 = 0.25;
/// Fastest rise of the speed: its logarithm per second.
pub const MOST_RISE_PER_SEC: f64 = 3.0;
/// Fastest fall of the speed: its logarithm per second.
pub const MOST_FALL_PER_SEC: f64 = 8.0;
/// Longest time step: after a pause the eye goes on from where it is.
const LONGEST_STEP_SECS: f64 = 0.1;

/// What the hand asks for during one time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlyInput {
    /// Right, up and forward in the camera's frame, each −1 to 1.
    pub travel: DVec3,
    /// Clockwise roll of the camera, −1 to 1.
    pub roll: f64,
    /// Turn of the view in radians: right and up.
    pub look_rad: DVec2,
    /// The fast key.
    pub faster: bool,
}

/// The distance that sets the speed, followed smoothly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlySpeed {
    /// Logarithm of the distance in scene units; none at rest.
    ln_distance: Option<f64>,
}

impl FlySpeed {
    /// Forgets the speed: the next travel starts from the distance found then.
    pub(super) fn rest(&mut self) {
        self.ln_distance = None;
    }

    /// Follows `distance` (above zero, scene units) for `dt_secs` and returns the smoothed one.
    pub fn follow(&mut self, distance: f64, dt_secs: f64) -> f64 {
        let wanted = distance.max(f64::MIN_POSITIVE).ln();
        let current = self.ln_distance.unwrap_or(wanted);
        let approach = (wanted - current) * (1.0 - (-dt_secs / TIME_CONSTANT_SECS).exp());
        let next =
            current + approach.clamp(-MOST_FALL_PER_SEC * dt_secs, MOST_RISE_PER_SEC * dt_secs);
        self.ln_distance = Some(next);
        next.exp()
    }
}

impl Navigator {
    /// Flies for `dt_secs`. Call it once a frame while a key is down or the pointer looks around;
    /// a call with nothing to do brings the speed to rest. Returns whether the camera changed.
    ///
    /// While the eye travels, the pivot rides ahead of it at the smoothed distance, so that the
    /// view unit follows the surroundings.
    pub fn fly(
        &mut self,
        camera: &mut Camera,
        world: World<'_>,
        input: FlyInput,
        dt_secs: f64,
    ) -> bool {
        if input == (FlyInput { faster: input.faster, ..FlyInput::default() }) {
            self.fly_speed.rest();
            return false;
        }
        self.gesture = None;
        self.flight = None;
        let before = camera.clone();
        let dt_secs = if dt_secs.is_finite() { dt_secs.clamp(0.0, LONGEST_STEP_SECS) } else { 0.0 };
        turn(camera, input, dt_secs, world.grain(camera));
        if input.travel == DVec3::ZERO || !input.travel.is_finite() {
            self.fly_speed.rest();
        } else {
            let distance = world.field.clear_distance(world.eye(camera)).max(world.nearest(camera));
            let followed = self.fly_speed.follow(distance, dt_secs);
            let speed = followed * SPEED_PER_SEC * if input.faster { FASTER } else { 1.0 };
            let DVec3 { x, y, z } = input.travel.clamp_length_max(1.0);
            let way = camera.rotation() * DVec3::new(x, y, -z) * speed * dt_secs;
            let moved = collide::slide(world, camera, way);
            shift(camera, world, moved);
            camera.pivot =
                camera.position.moved_by(camera.forward() * followed, world.grain(camera));
        }
        *camera != before
    }

    /// The speed that [`Self::fly`] last travelled at without the fast key, in scene units per
    /// second; none at rest.
    pub fn speed(&self) -> Option<f64> {
        self.fly_speed.ln_distance.map(|ln| ln.exp() * SPEED_PER_SEC)
    }
}

fn turn(camera: &mut Camera, input: FlyInput, dt_secs: f64, grain: f64) {
    if input.look_rad != DVec2::ZERO && input.look_rad.is_finite() {
        let left_and_up = DVec2::new(-input.look_rad.x, input.look_rad.y);
        Turntable::of(camera).look(camera, left_and_up, grain);
    }
    if input.roll != 0.0 && input.roll.is_finite() {
        let roll =
            DQuat::from_rotation_z(-input.roll.clamp(-1.0, 1.0) * ROLL_RAD_PER_SEC * dt_secs);
        camera.orientation = (camera.rotation() * roll).normalize().into();
    }
}
