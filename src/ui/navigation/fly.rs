//! Flying by keys.
//!
//! The speed is proportional to the distance to the surface. The distance's logarithm is smoothed
//! by a time constant and a maximum rate. If a hole opens beside the eye, the speed rises over
//! about a second; in front of a wall, the speed falls faster. The distance is at least
//! [`World::nearest`], so the eye never stops.

use glam::{DQuat, DVec2, DVec3};

use super::{collide, placement::shift, turntable::Turntable, world::World};
use crate::scene::Camera;

/// Speed per second, in distances to the surface.
const SPEED_PER_SEC: f64 = 1.2;
/// Factor on the speed while the fast key is down.
const FASTER: f64 = 4.0;
/// Roll rate while a roll key is down.
const ROLL_RAD_PER_SEC: f64 = 0.9;
/// Time constant of the speed's smoothing: 63 % of a change.
const TIME_CONSTANT_SECS: f64 = 0.25;
/// Maximum rise of the speed: natural logarithm per second.
pub const MAX_RISE_PER_SEC: f64 = 3.0;
/// Maximum fall of the speed: natural logarithm per second.
pub const MAX_FALL_PER_SEC: f64 = 8.0;
/// Maximum time step; prevents a jump after a pause of the program.
const MAX_STEP_SECS: f64 = 0.1;

/// The user's input during one time step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlyInput {
    /// Right, up and forward in the camera's frame, each −1 to 1.
    pub travel: DVec3,
    /// Clockwise roll of the camera, −1 to 1.
    pub roll: f64,
    /// Rotation of the view in radians: right and up.
    pub look_rad: DVec2,
    /// True while the fast key is down.
    pub faster: bool,
}

impl FlyInput {
    /// True if the input moves nothing: the fast key alone has no effect.
    pub(super) fn is_empty(self) -> bool {
        self == (Self { faster: self.faster, ..Self::default() })
    }
}

/// The smoothed distance to the surface, which determines the speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlySpeed {
    /// Logarithm of the distance in scene units; none at rest.
    ln_distance: Option<f64>,
}

impl FlySpeed {
    /// Resets the smoothing: the next movement starts at the actual distance.
    pub(super) fn reset(&mut self) {
        self.ln_distance = None;
    }

    /// Smooths `distance` (above zero, scene units) over `dt_secs` and returns the result.
    pub fn smooth(&mut self, distance: f64, dt_secs: f64) -> f64 {
        let wanted = distance.max(f64::MIN_POSITIVE).ln();
        let current = self.ln_distance.unwrap_or(wanted);
        let approach = (wanted - current) * (1.0 - (-dt_secs / TIME_CONSTANT_SECS).exp());
        let next =
            current + approach.clamp(-MAX_FALL_PER_SEC * dt_secs, MAX_RISE_PER_SEC * dt_secs);
        self.ln_distance = Some(next);
        next.exp()
    }

    /// The speed without the fast key, in scene units per second; none at rest.
    pub(super) fn per_sec(self) -> Option<f64> {
        self.ln_distance.map(|ln| ln.exp() * SPEED_PER_SEC)
    }
}

/// Flies for `dt_secs` at the smoothed `speed`. Returns whether the camera changed.
pub(super) fn fly(
    speed: &mut FlySpeed,
    camera: &mut Camera,
    world: World<'_>,
    input: FlyInput,
    dt_secs: f64,
) -> bool {
    let before = camera.clone();
    let dt_secs = if dt_secs.is_finite() { dt_secs.clamp(0.0, MAX_STEP_SECS) } else { 0.0 };
    rotate(camera, input, dt_secs, world.grain(camera));
    if input.travel == DVec3::ZERO || !input.travel.is_finite() {
        speed.reset();
    } else {
        let distance = world.field.clear_distance(world.eye(camera)).max(world.nearest(camera));
        let smoothed = speed.smooth(distance, dt_secs);
        let per_sec = smoothed * SPEED_PER_SEC * if input.faster { FASTER } else { 1.0 };
        let DVec3 { x, y, z } = input.travel.clamp_length_max(1.0);
        let displacement = camera.rotation() * DVec3::new(x, y, -z) * per_sec * dt_secs;
        let moved = collide::slide(world, camera, displacement);
        shift(camera, world, moved);
        camera.pivot = camera.position.moved_by(camera.forward() * smoothed, world.grain(camera));
    }
    *camera != before
}

fn rotate(camera: &mut Camera, input: FlyInput, dt_secs: f64, grain: f64) {
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
