//! How far the eye may go.
//!
//! A movement is walked in steps that the distance estimate allows, half as long as a camera
//! ray's, and every place it would stop at is looked at before it is taken. An eye that is too
//! near already (the fractal was changed around it) may only move to where there is more room;
//! one that is inside moves freely until it is out.

use glam::DVec3;

use super::{FARTHEST_EYE, World};
use crate::{
    fractal::{DistanceField, LEAST_STEP},
    scene::Camera,
};

/// Part of a camera ray's step that the eye takes: it must not pass what rays would hit.
const STEP_PART: f64 = 0.5;
/// Part of the distance that a step is tried with where there is no room to come nearer.
const BOLD: f64 = 0.25;
/// Part of a slide that leads away from the surface, so that a hollow one does not stop it.
const LIFT: f64 = 0.05;
/// Most steps of one movement.
const MAX_STEPS: u32 = 256;
/// A step shorter than this part of the clearance means that the eye has arrived.
const ARRIVED: f64 = 1e-3;
/// The least clearance, in parts of a place's distance from the field's origin: closer by, f64
/// coordinates say nothing of the surface. A field with a nearer origin lets the eye go on.
const RESOLVED: f64 = 1e-12;
/// How often a movement may be turned along the surface.
const MAX_SLIDES: u32 = 3;

/// The part of `way` that the eye may go straight on.
pub fn advance(world: World<'_>, camera: &Camera, way: DVec3) -> DVec3 {
    sweep(world.field, world.eye(camera), within_limit(camera, way), world.clearance(camera))
}

/// Where the eye gets to by going `way`, turned along the surface where that stops it.
pub fn slide(world: World<'_>, camera: &Camera, way: DVec3) -> DVec3 {
    let clearance = world.clearance(camera);
    let start = world.eye(camera);
    let mut gone = DVec3::ZERO;
    let mut left = within_limit(camera, way);
    for _ in 0..=MAX_SLIDES {
        let moved = sweep(world.field, start + gone, left, clearance);
        gone += moved;
        left -= moved;
        if left.length() <= ARRIVED * clearance {
            break;
        }
        let eye = start + gone;
        let spacing = 0.5 * world.field.distance(eye).clamp(0.1 * clearance, clearance);
        let normal = world.field.normal(eye, spacing);
        left -= normal * (left.dot(normal).min(0.0) - LIFT * left.length());
    }
    gone
}

/// True where the eye may go straight from `from` to `to`, both in the field's coordinates.
pub fn is_free(field: &dyn DistanceField, from: DVec3, to: DVec3, clearance: f64) -> bool {
    let way = to - from;
    sweep(field, from, way, clearance) == way
}

/// The part of `way` from `from` that keeps `clearance`: all of `way` itself where it is free.
fn sweep(field: &dyn DistanceField, from: DVec3, way: DVec3, clearance: f64) -> DVec3 {
    let length = way.length();
    let mut here = field.clear_estimate(from);
    if here.distance <= 0.0 || length == 0.0 || !length.is_finite() {
        return if length.is_finite() { way } else { DVec3::ZERO };
    }
    let direction = way / length;
    let mut gone = 0.0;
    for _ in 0..MAX_STEPS {
        // Along a surface there is no room to come nearer, yet the way may be free: a bold step
        // first, then one that the room allows.
        let clearance = clearance.max(RESOLVED * (from + direction * gone).length());
        let room = here.distance - clearance;
        let longest = here.step.max(LEAST_STEP * clearance);
        let steps = [room.max(BOLD * here.distance), room].map(|it| STEP_PART * it.min(longest));
        let taken = steps.into_iter().filter(|&step| step > ARRIVED * clearance).find_map(|step| {
            let reached = (gone + step).min(length);
            // The estimate is no bound, so the place itself has the last word.
            let next = field.clear_estimate(from + direction * reached);
            (next.distance > 0.0 && next.distance >= clearance.min(here.distance))
                .then_some((reached, next))
        });
        match taken {
            None => break,
            Some((reached, _)) if reached >= length => return way,
            Some(place) => (gone, here) = place,
        }
    }
    direction * gone
}

/// `way`, shortened so that it does not lead out of the sphere that the eye is kept in.
fn within_limit(camera: &Camera, way: DVec3) -> DVec3 {
    // The limit is far from any surface: here an f64 of the whole scene will do.
    let eye = camera.position.to_dvec3();
    let end = eye + way;
    if end.length() <= FARTHEST_EYE || end.length() <= eye.length() {
        return way;
    }
    // Solve |eye + t·way| = limit for the larger t, at most 1 here.
    let (a, b) = (way.length_squared(), eye.dot(way));
    let c = eye.length_squared() - FARTHEST_EYE * FARTHEST_EYE;
    let t = ((b * b - a * c).max(0.0).sqrt() - b) / a;
    way * t.clamp(0.0, 1.0)
}
