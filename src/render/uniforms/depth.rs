//! The anchor's orbit as the shaders see it, and what orbits skip.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::DVec3;

use super::{Picture, Place, Skip};
use crate::{
    fractal::deep::{self, reference::MOST_PLACES},
    render::datum::Datum,
};

/// How many skips there are.
pub const SKIPS: usize = 8;

/// Bytes that all places of an orbit may take.
pub const PLACES_BYTES: u64 = (MOST_PLACES * size_of::<Place>()) as u64;

/// How far from the anchor points may be that skip the most steps, in scales: what is in view, and
/// the reach of its shadows.
const FIRST_RADIUS: f64 = 3.0;
/// From each radius to the next.
const RADII_RATIO: f64 = 8.0;

/// Skips, nearest to the anchor first.
pub type Skips = [Skip; SKIPS];

/// The places of an anchor's orbit; one that means nothing where there is none.
pub fn places(datum: &Datum) -> Arc<[Place]> {
    let nothing = [Place::zeroed()];
    let Some(reference) = datum.reference() else { return Arc::new(nothing) };
    reference.places().iter().map(place).collect()
}

fn place(place: &deep::Place) -> Place {
    Place {
        z: place.z.as_vec3().to_array(),
        rho: place.rho as f32,
        rotor: place.rotor.as_vec2().to_array(),
        unused: [0; 2],
    }
}

/// What orbits near the anchor skip; nothing where there is none.
pub fn skips(datum: &Datum) -> Skips {
    let Some(reference) = datum.reference() else { return [Skip::zeroed(); SKIPS] };
    let radii: [f64; SKIPS] = std::array::from_fn(|i| FIRST_RADIUS * RADII_RATIO.powi(i as i32));
    let mut skips = [Skip::zeroed(); SKIPS];
    for (skip, found) in skips.iter_mut().zip(reference.skips(datum.scale(), &radii)) {
        *skip = packed(&found);
    }
    skips
}

fn packed(skip: &deep::Skip) -> Skip {
    let [x, y, z] = skip.difference;
    let vector = |part: DVec3| part.as_vec3().to_array();
    let of_each =
        |part: fn(&deep::jet::Jet) -> f64| vector(DVec3::new(part(&x), part(&y), part(&z)));
    Skip {
        along_x: of_each(|jet| jet.gradient.x),
        steps: skip.steps,
        along_y: of_each(|jet| jet.gradient.y),
        derivative: skip.derivative.value as f32,
        along_z: of_each(|jet| jet.gradient.z),
        along_xx: of_each(|jet| jet.pure.x),
        along_yy: of_each(|jet| jet.pure.y),
        along_zz: of_each(|jet| jet.pure.z),
        along_xy: of_each(|jet| jet.mixed.x),
        along_yz: of_each(|jet| jet.mixed.y),
        along_zx: of_each(|jet| jet.mixed.z),
        derivative_gradient: vector(skip.derivative.gradient),
        traps_squared: vector(skip.traps_squared),
        ..Skip::zeroed()
    }
}

/// Puts what most orbits read into the picture itself.
pub fn put_near(picture: &mut Picture, skips: &Skips, places: &[Place]) {
    picture.skip = skips[0];
    picture.near_index = skips[0].steps;
    picture.restart = places[picture.fractal.restart as usize];
    for (near, place) in picture.near.iter_mut().zip(&places[skips[0].steps as usize..]) {
        *near = *place;
    }
}
