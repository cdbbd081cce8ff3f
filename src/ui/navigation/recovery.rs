//! Recovery of a view that shows no surface: zooming out turns it toward the nearest surface.

use glam::{DVec2, DVec3};

use super::{
    collide,
    placement::{place_pivot, shift},
    turntable::Turntable,
    world::World,
};
use crate::scene::Camera;

/// Rate at which the view turns toward the surface, per unit of zoom.
const TURN_RATE: f64 = 2.0;

/// Part of the picture, from its middle to its edge, where the surface is back in view.
const MIDDLE: f64 = 0.4;

/// Moves the eye away from the nearest surface by a factor of `exp(amount)`, and turns toward it.
///
/// `amount` is above zero. Returns whether the surface is in the middle of the picture.
pub fn step(camera: &mut Camera, world: World<'_>, amount: f64) -> bool {
    let amount = amount.min(20.0);
    let eye = world.eye(camera);
    let distance = world.field.clear_distance(eye).max(world.nearest(camera));
    let outward = world.field.normal(eye, 0.1 * distance);
    let moved = collide::slide(world, camera, outward * (distance * amount.exp_m1()));
    shift(camera, world, moved);
    let part = -(-TURN_RATE * amount).exp_m1();
    let grain = world.grain(camera);
    Turntable::of(camera).look(camera, turn_toward(camera, -outward) * part, grain);
    place_pivot(camera, camera.forward() * (distance + moved.length()), grain);
    world.ndc_of(camera, -outward).is_some_and(|seen| seen.abs().max_element() <= MIDDLE)
}

/// The turn, left and up in radians, after which a level camera looks along `direction`.
fn turn_toward(camera: &Camera, direction: DVec3) -> DVec2 {
    let seen = camera.rotation().inverse() * direction;
    let left = (-seen.x).atan2(-seen.z);
    DVec2::new(left, seen.y.atan2(seen.x.hypot(seen.z)))
}
