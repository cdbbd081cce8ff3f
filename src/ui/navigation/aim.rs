//! What a zoom or an orbit holds on to: the surface in the picture nearest to the pointer.
//!
//! In: the world, a camera, the pointer. Out: a place in the picture where the surface is, and how
//! far it is. Where the pointer's ray misses, the search goes from the ray's closest approach
//! toward the surface there; then outward on a spiral; then to the middle of a set too small for
//! the spiral. What it finds is brought back toward the pointer by bisection. A search has at most
//! 70 rays, most of them short.

use glam::DVec2;

use super::world::World;
use crate::{fractal::spiral::GOLDEN_ANGLE_RAD, scene::Camera};

/// Rays from a closest approach toward the surface.
const APPROACHES: u32 = 3;
/// Rays on the spiral.
const SPIRAL_RAYS: u32 = 48;
/// First and last radius of the spiral, in half heights of the picture.
const SPIRAL_RADII: [f64; 2] = [0.008, 2.4];
/// Bisections between the pointer and what was found.
const BISECTIONS: u32 = 8;

/// A place of the picture where the surface is.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Normalised device coordinates.
    pub ndc: DVec2,
    /// The vector from the eye to the surface, in scene units.
    pub offset: glam::DVec3,
}

/// The surface under the pointer, or the nearest in the picture; none if the picture shows none.
pub fn nearest(world: World<'_>, camera: &Camera, pointer: DVec2) -> Option<Aim> {
    if let Some(offset) = world.pick(camera, pointer) {
        return Some(Aim { ndc: pointer, offset });
    }
    let mut found = approached(world, camera, pointer)
        .or_else(|| on_spiral(world, camera, pointer))
        .or_else(|| in_middle(world, camera))?;
    let mut missed = pointer;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (missed + found.ndc);
        match hit(world, camera, middle) {
            Some(nearer) => found = nearer,
            None => missed = middle,
        }
    }
    Some(found)
}

/// The surface at a place of the picture.
fn hit(world: World<'_>, camera: &Camera, ndc: DVec2) -> Option<Aim> {
    if ndc.abs().max_element() > 1.0 {
        return None;
    }
    world.glance(camera, ndc).map(|offset| Aim { ndc, offset })
}

/// From the ray's closest approach to the surface there, and again from the ray through that.
fn approached(world: World<'_>, camera: &Camera, pointer: DVec2) -> Option<Aim> {
    let mut ndc = pointer;
    for _ in 0..APPROACHES {
        let ray = world.ray(camera, ndc);
        let closest = ray.at(world.closest_approach(camera, ray));
        let distance = world.field.clear_distance(closest);
        let normal = world.field.normal(closest, 0.1 * distance);
        ndc = world.ndc_of(camera, closest - normal * distance - ray.origin)?;
        if ndc.abs().max_element() > 1.0 {
            return None;
        }
        if let Some(aim) = hit(world, camera, ndc) {
            return Some(aim);
        }
    }
    None
}

fn on_spiral(world: World<'_>, camera: &Camera, pointer: DVec2) -> Option<Aim> {
    let [first, last] = SPIRAL_RADII;
    (0..SPIRAL_RAYS).find_map(|i| {
        let radius = first * (last / first).powf(f64::from(i) / f64::from(SPIRAL_RAYS - 1));
        let aside = DVec2::from_angle(GOLDEN_ANGLE_RAD * f64::from(i)) * radius;
        hit(world, camera, pointer + aside / DVec2::new(world.viewport.aspect, 1.0))
    })
}

/// Toward the middle of the set.
fn in_middle(world: World<'_>, camera: &Camera) -> Option<Aim> {
    let middle = world.ndc_of(camera, world.field.center() - world.eye(camera))?;
    hit(world, camera, middle)
}
