//! Placement of eye and pivot, with rounding.

use glam::{DQuat, DVec3};

use super::world::World;
use crate::scene::{Camera, PrecisePoint};

/// Rounding of the pivot, in view units.
const PIVOT_GRAIN: f64 = 1e-6;

/// Difference, in parts of the distance, from which on the pivot is where it glides to.
const ARRIVED: f64 = 1e-2;

/// Moves eye and pivot together by `moved`, in scene units.
pub fn shift(camera: &mut Camera, world: World<'_>, moved: DVec3) {
    let grain = world.grain(camera).min(world.grain_after(camera, moved));
    let pivot_offset = &camera.pivot - &camera.position;
    camera.position = camera.position.moved_by(moved, grain);
    place_pivot(camera, pivot_offset, grain);
}

/// Places the pivot at `offset` from the eye, rounded to at most `grain`.
///
/// A pivot near the eye is rounded to [`PIVOT_GRAIN`] of its distance.
pub fn place_pivot(camera: &mut Camera, offset: DVec3, grain: f64) {
    camera.pivot = camera.position.moved_by(offset, grain.min(PIVOT_GRAIN * offset.length()));
}

/// Moves the pivot by the fraction `part` of the way to `target`.
///
/// Its distance changes by equal factors, its direction by equal angles. All that is measured in
/// view units, such as the reach of shadows, changes smoothly.
pub fn glide_pivot(camera: &mut Camera, target: &PrecisePoint, part: f64) {
    if camera.pivot == *target {
        return;
    }
    let [from, to] = [&camera.pivot, target].map(|point| point - &camera.position);
    let distance = from.length() * (to.length() / from.length()).powf(part);
    let arc = DQuat::from_rotation_arc(from.normalize_or(DVec3::Z), to.normalize_or(DVec3::Z));
    let direction = DQuat::IDENTITY.slerp(arc, part) * from.normalize_or(DVec3::Z);
    let offset = direction * distance;
    if offset.distance(to) <= ARRIVED * to.length() || !offset.is_finite() {
        camera.pivot = target.clone();
    } else {
        place_pivot(camera, offset, f64::INFINITY);
    }
}
