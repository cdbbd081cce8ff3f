//! Collision of the eye with the surface.
//!
//! A movement is divided into steps of at most half a camera ray's step, and the distance estimate
//! is checked at the end of every step. An eye that is too near already (because the fractal was
//! edited) may only move to where the distance is larger. An eye inside the fractal moves freely
//! until it is outside.

use glam::DVec3;

use super::world::{MAX_EYE_DISTANCE, World};
use crate::{
    formula::{DistanceField, march::MIN_STEP},
    scene::Camera,
};

/// The eye's step as a fraction of a camera ray's step.
///
/// Below 1, so that the eye cannot pass a surface that rays hit.
const STEP_PART: f64 = 0.5;
/// Trial step without room to come nearer, as a fraction of the distance.
const TRIAL_STEP: f64 = 0.25;
/// Fraction of a slide that leads away from the surface.
///
/// Without it, a concave surface would block the slide.
const LIFT: f64 = 0.05;
/// Maximum number of steps of one movement.
const MAX_STEPS: u32 = 256;
/// Step length, as a fraction of the clearance, below which the eye has arrived.
const ARRIVED: f64 = 1e-3;
/// Minimum clearance, as a fraction of a point's distance from the field's origin.
///
/// Below, f64 coordinates do not resolve the surface. A field with a nearer origin has a smaller
/// minimum.
const RESOLVED: f64 = 1e-12;
/// Maximum number of slides of one movement.
const MAX_SLIDES: u32 = 3;

/// The straight part of `displacement` that the surface does not block.
pub fn advance(world: World<'_>, camera: &Camera, displacement: DVec3) -> DVec3 {
    let displacement = within_limit(camera, displacement);
    sweep(world.field, world.eye(camera), displacement, world.clearance(camera))
}

/// The eye's movement for `displacement`, which slides along a surface that blocks it.
pub fn slide(world: World<'_>, camera: &Camera, displacement: DVec3) -> DVec3 {
    let clearance = world.clearance(camera);
    let start = world.eye(camera);
    let mut total = DVec3::ZERO;
    let mut left = within_limit(camera, displacement);
    for _ in 0..=MAX_SLIDES {
        let moved = sweep(world.field, start + total, left, clearance);
        total += moved;
        left -= moved;
        if left.length() <= ARRIVED * clearance {
            break;
        }
        let eye = start + total;
        let spacing = 0.5 * world.field.distance(eye).max(0.1 * clearance).min(clearance);
        let normal = world.field.normal(eye, spacing);
        left -= normal * (left.dot(normal).min(0.0) - LIFT * left.length());
    }
    total
}

/// True if no surface blocks the line from `from` to `to`.
///
/// Both points are in the field's coordinates.
pub fn is_free(field: &dyn DistanceField, from: DVec3, to: DVec3, clearance: f64) -> bool {
    let displacement = to - from;
    sweep(field, from, displacement, clearance) == displacement
}

/// The part of `displacement` that keeps `clearance`; equal to `displacement` if nothing blocks.
fn sweep(field: &dyn DistanceField, from: DVec3, displacement: DVec3, clearance: f64) -> DVec3 {
    let length = displacement.length();
    let mut here = field.clear_estimate(from);
    if here.distance <= 0.0 || length == 0.0 || !length.is_finite() {
        return if length.is_finite() { displacement } else { DVec3::ZERO };
    }
    let direction = displacement / length;
    let mut travelled = 0.0;
    for _ in 0..MAX_STEPS {
        // A movement along a surface may be free although there is no room to come nearer. So a
        // trial step comes first, then a step within the room.
        let clearance = clearance.max(RESOLVED * (from + direction * travelled).length());
        let room = here.distance - clearance;
        let max_step = here.step.max(MIN_STEP * clearance);
        let steps =
            [room.max(TRIAL_STEP * here.distance), room].map(|it| STEP_PART * it.min(max_step));
        let taken = steps.into_iter().filter(|&step| step > ARRIVED * clearance).find_map(|step| {
            let reached = (travelled + step).min(length);
            // The estimate is not a lower bound, so the distance is checked at the step's end.
            let next = field.clear_estimate(from + direction * reached);
            (next.distance > 0.0 && next.distance >= clearance.min(here.distance))
                .then_some((reached, next))
        });
        match taken {
            None => break,
            Some((reached, _)) if reached >= length => return displacement,
            Some(step) => (travelled, here) = step,
        }
    }
    direction * travelled
}

/// `displacement`, shortened so that the eye stays within [`MAX_EYE_DISTANCE`].
fn within_limit(camera: &Camera, displacement: DVec3) -> DVec3 {
    // The limit is far from any surface, so f64 scene coordinates are precise enough.
    let eye = camera.position.to_dvec3();
    let end = eye + displacement;
    if end.length() <= MAX_EYE_DISTANCE || end.length() <= eye.length() {
        return displacement;
    }
    // Solve |eye + t·displacement| = limit for the larger t, which is at most 1.
    let (a, b) = (displacement.length_squared(), eye.dot(displacement));
    let c = eye.length_squared() - MAX_EYE_DISTANCE * MAX_EYE_DISTANCE;
    let t = ((b * b - a * c).max(0.0).sqrt() - b) / a;
    displacement * t.clamp(0.0, 1.0)
}
