//! The anchor's orbit as the shaders see it, and what orbits skip.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::DVec3;

use super::{Place, Skip};
use crate::{
    fractal::{
        Reference,
        deep::{self, reference::MOST_PLACES},
    },
    render::datum::Datum,
};

/// Bytes that all places of an orbit may take.
pub const PLACES_BYTES: u64 = (MOST_PLACES * size_of::<Place>()) as u64;

/// Points up to so many scales from the anchor skip steps: what is in view, and the reach of its
/// shadows.
const SKIP_RADIUS: f64 = 3.0;

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
pub fn skip(datum: &Datum) -> Skip {
    match datum.reference() {
        Some(reference) => skip_about(reference, datum.scale()),
        None => Skip { radius: -1.0, ..Skip::zeroed() },
    }
}

fn skip_about(reference: &Reference, scale: f64) -> Skip {
    let skip = reference.skip(scale, SKIP_RADIUS);
    let [x, y, z] = skip.difference;
    let vector = |part: DVec3| part.as_vec3().to_array();
    let of_each =
        |part: fn(&deep::jet::Jet) -> f64| vector(DVec3::new(part(&x), part(&y), part(&z)));
    Skip {
        along_x: of_each(|jet| jet.gradient.x),
        radius: SKIP_RADIUS as f32,
        along_y: of_each(|jet| jet.gradient.y),
        steps: skip.steps,
        along_z: of_each(|jet| jet.gradient.z),
        derivative: skip.derivative.value as f32,
        along_xx: of_each(|jet| jet.pure.x),
        careful: skip.careful as f32,
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
