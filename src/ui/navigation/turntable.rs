//! Turntable rotations, which keep the horizon level.
//!
//! An upright camera (its right vector is horizontal) rotates as on a turntable: about the scene's
//! z axis, and up or down until half a degree from the poles. A rolled camera rotates about its
//! own axes and has no poles. Each gesture chooses the mode at its start.

use glam::{DQuat, DVec2, DVec3};

use super::{
    collide,
    placement::{place_pivot, shift},
    world::World,
};
use crate::scene::{Camera, PrecisePoint};

/// Maximum elevation of an upright camera, up or down.
const MAX_ELEVATION_RAD: f64 = 89.5 * std::f64::consts::PI / 180.0;
/// Longest arc that counts as one straight step.
const ARC_STEP_RAD: f64 = std::f64::consts::PI / 90.0;
/// Maximum number of arc steps of one call: a full circle.
const MAX_ARC_STEPS: f64 = 180.0;

/// The rotation axes of a gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turntable {
    /// The scene's z axis and the camera's right vector.
    Upright,
    /// The camera's up and right vectors.
    Free,
}

impl Turntable {
    /// The rotation axes for `camera`.
    pub fn of(camera: &Camera) -> Self {
        if camera.is_upright() { Self::Upright } else { Self::Free }
    }

    /// The rotation of `camera` by `turn` radians, left and up, in world space.
    ///
    /// The rotation of an upright camera stops at the poles.
    fn rotation(self, camera: &Camera, turn: DVec2) -> DQuat {
        let rotation = camera.rotation();
        let right = rotation * DVec3::X;
        match self {
            Self::Upright => {
                let elevation = camera.forward().z.clamp(-1.0, 1.0).asin();
                let low = elevation.min(-MAX_ELEVATION_RAD);
                let high = elevation.max(MAX_ELEVATION_RAD);
                let up = (elevation + turn.y).clamp(low, high) - elevation;
                DQuat::from_rotation_z(turn.x) * DQuat::from_axis_angle(right, up)
            }
            Self::Free => {
                DQuat::from_axis_angle(rotation * DVec3::Y, turn.x)
                    * DQuat::from_axis_angle(right, turn.y)
            }
        }
    }

    /// Rotates the camera and its pivot about the eye by `turn` radians, left and up.
    pub fn look(self, camera: &mut Camera, turn: DVec2, grain: f64) {
        let rotation = self.rotation(camera, turn);
        let pivot_offset = &camera.pivot - &camera.position;
        camera.orientation = (rotation * camera.rotation()).normalize().into();
        place_pivot(camera, rotation * pivot_offset, grain);
    }

    /// Rotates eye, view and pivot about `center` by `turn` radians, at constant distances.
    ///
    /// If the surface blocks a step, the horizontal or the vertical part of the step is tried.
    pub fn orbit(self, camera: &mut Camera, world: World<'_>, center: &PrecisePoint, turn: DVec2) {
        if !turn.is_finite() {
            return;
        }
        let steps = (turn.length() / ARC_STEP_RAD).ceil().clamp(1.0, MAX_ARC_STEPS);
        let step = turn / steps;
        for _ in 0..steps as u32 {
            let parts = [step, DVec2::new(step.x, 0.0), DVec2::new(0.0, step.y)];
            if !parts
                .into_iter()
                .any(|part| part != DVec2::ZERO && self.orbit_step(camera, world, center, part))
            {
                return;
            }
        }
    }

    /// Makes one straight step of an orbit. False, without a change, if the surface blocks it.
    fn orbit_step(
        self,
        camera: &mut Camera,
        world: World<'_>,
        center: &PrecisePoint,
        turn: DVec2,
    ) -> bool {
        let rotation = self.rotation(camera, turn);
        let arm = &camera.position - center;
        let displacement = rotation * arm - arm;
        if collide::advance(world, camera, displacement) != displacement {
            return false;
        }
        let pivot_offset = &camera.pivot - &camera.position;
        let is_pivot = camera.pivot == *center;
        shift(camera, world, displacement);
        if is_pivot {
            camera.pivot = center.clone();
        } else {
            place_pivot(camera, rotation * pivot_offset, world.grain(camera));
        }
        camera.orientation = (rotation * camera.rotation()).normalize().into();
        true
    }
}
