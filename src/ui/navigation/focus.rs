//! The focus of the camera's lens.

use glam::DVec2;

use super::world::World;
use crate::scene::{Camera, param};

/// Focuses the lens on the surface at `ndc`, or in the middle of the picture, with a depth of field.
///
/// The camera stays as it is where no surface is seen.
pub fn focus(camera: &mut Camera, world: World<'_>, ndc: Option<DVec2>) {
    let Some(offset) = world.pick(camera, ndc.unwrap_or_default()) else { return };
    let depth = offset.dot(camera.forward()) / camera.view_unit();
    camera.lens.focus = param::FOCUS.clamp(depth);
    camera.lens.depth_of_field = true;
}
