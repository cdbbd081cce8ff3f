//! Placement of eye and pivot, with rounding.

use glam::DVec3;

use super::world::World;
use crate::scene::Camera;

/// Rounding of the pivot, in view units.
const PIVOT_GRAIN: f64 = 1e-6;

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
