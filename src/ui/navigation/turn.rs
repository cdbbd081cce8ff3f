//! Rotations that keep the horizon.
//!
//! A camera that stands upright (its right vector level) turns as on a turntable: about the
//! scene's z axis, and up or down to half a degree from the poles, where it stops and never
//! flips. A camera that is rolled turns about its own axes and has no poles. Which of the two it
//! is gets decided when a gesture begins.

use glam::{DQuat, DVec2, DVec3};

use super::{World, collide, place_pivot, shift};
use crate::scene::Camera;

/// Steepest look up or down of an upright camera.
const STEEPEST_RAD: f64 = 89.5 * std::f64::consts::PI / 180.0;
/// Largest vertical part of an upright camera's right vector.
const LEVEL: f64 = 1e-3;
/// Longest arc that is taken as one straight step.
const ARC_STEP_RAD: f64 = std::f64::consts::PI / 90.0;
/// Most arc steps of one call: a whole turn.
const MAX_ARC_STEPS: f64 = 180.0;

/// What a gesture turns about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turntable {
    /// The scene's z axis and the camera's right.
    Upright,
    /// The camera's own up and right.
    Free,
}

impl Turntable {
    /// How `camera` turns.
    pub fn of(camera: &Camera) -> Self {
        let rotation = camera.rotation();
        let level = (rotation * DVec3::X).z.abs() <= LEVEL && (rotation * DVec3::Y).z >= -LEVEL;
        if level { Self::Upright } else { Self::Free }
    }

    /// The rotation, in world space, that turns `camera` by `turn` radians (left about the
    /// vertical, then up), as far as the poles allow.
    fn rotation(self, camera: &Camera, turn: DVec2) -> DQuat {
        let rotation = camera.rotation();
        let right = rotation * DVec3::X;
        match self {
            Self::Upright => {
                let steepness = camera.forward().z.clamp(-1.0, 1.0).asin();
                let (low, high) = (steepness.min(-STEEPEST_RAD), steepness.max(STEEPEST_RAD));
                let up = (steepness + turn.y).clamp(low, high) - steepness;
                DQuat::from_rotation_z(turn.x) * DQuat::from_axis_angle(right, up)
            }
            Self::Free => {
                DQuat::from_axis_angle(rotation * DVec3::Y, turn.x)
                    * DQuat::from_axis_angle(right, turn.y)
            }
        }
    }

    /// Turns the camera on the spot by `turn` radians: left, then up. Its pivot turns with it.
    pub fn look(self, camera: &mut Camera, turn: DVec2, grain: f64) {
        let rotation = self.rotation(camera, turn);
        let pivot_offset = &camera.pivot - &camera.position;
        camera.orientation = (rotation * camera.rotation()).normalize().into();
        place_pivot(camera, rotation * pivot_offset, grain);
    }

    /// Turns eye and view about the pivot by `turn` radians, the eye keeping its distance to it.
    /// Where the surface is in the way it goes on with the part of the turn that is free.
    pub fn orbit(self, camera: &mut Camera, world: World<'_>, turn: DVec2) {
        if !turn.is_finite() {
            return;
        }
        let steps = (turn.length() / ARC_STEP_RAD).ceil().clamp(1.0, MAX_ARC_STEPS);
        let step = turn / steps;
        for _ in 0..steps as u32 {
            let parts = [step, DVec2::new(step.x, 0.0), DVec2::new(0.0, step.y)];
            if !parts
                .into_iter()
                .any(|part| part != DVec2::ZERO && self.orbit_step(camera, world, part))
            {
                return;
            }
        }
    }

    /// One straight step of an orbit; false, and nothing done, where the surface is in the way.
    fn orbit_step(self, camera: &mut Camera, world: World<'_>, turn: DVec2) -> bool {
        let rotation = self.rotation(camera, turn);
        let arm = &camera.position - &camera.pivot;
        let way = rotation * arm - arm;
        if collide::advance(world, camera, way) != way {
            return false;
        }
        let pivot = camera.pivot.clone();
        shift(camera, world, way);
        camera.pivot = pivot;
        camera.orientation = (rotation * camera.rotation()).normalize().into();
        true
    }
}
