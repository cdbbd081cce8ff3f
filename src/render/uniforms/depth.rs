//! The anchor's orbit as the shaders see it, and what orbits skip.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::{DMat3, DVec3, Vec3};

use super::{NEAR_STEPS, Picture, Place, Skip};
use crate::{
    fractal::deep::{self, reference::MOST_PLACES, spread::norm},
    render::datum::Datum,
};

/// How many skips there are.
pub const SKIPS: usize = 8;

/// Bytes that all places of an orbit may take.
pub const PLACES_BYTES: u64 = (MOST_PLACES * size_of::<Place>()) as u64;

/// How far from the anchor points may be that skip the most steps, in scales: what is in view, the
/// reach of its shadows, and what a crevice shows of the walls behind it.
pub const FIRST_RADIUS: f64 = 12.0;
/// From each radius to the next.
pub const RADII_RATIO: f64 = 8.0;

/// How far from the anchor orbits may take the near steps together, in scales: the last that costs no
/// step beside [`FIRST_RADIUS`], and a nearer one only where that is too far.
const NEAR_RADII: [f64; 7] = [1.5, 3.0, 6.0, FIRST_RADIUS, 24.0, 48.0, 96.0];

/// Behind the near steps an f32 knows places to 3e-8, and points to that over dr. It should be no more
/// than a tenth of the hit distance: orbits whose dr, in units of one over the scale, falls below this
/// over the hit cone, as where they come by the origin, follow the difference itself for longer.
const LEAST_DERIVATIVE: f32 = 3e-7;

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
    let jacobian = DMat3::from_cols(x.gradient, y.gradient, z.gradient).transpose();
    let widest = widest_direction(jacobian);
    let stretched = jacobian * widest;
    let rest = norm(&jacobian).powi(2) - stretched.length_squared();
    Skip {
        widest: vector(widest),
        rest: rest.max(0.0).sqrt() as f32,
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

/// The direction that a map stretches most, a unit vector; any where it stretches nothing.
fn widest_direction(map: DMat3) -> DVec3 {
    // Powers of its square, each the last one's square, tend to the projection onto that direction.
    let mut power = map.transpose() * map;
    for _ in 0..16 {
        power *= power.to_cols_array().into_iter().fold(0.0, f64::max).recip();
        power *= power;
    }
    let columns = [power.x_axis, power.y_axis, power.z_axis];
    let longest = columns.into_iter().max_by(|u, v| u.length().total_cmp(&v.length()));
    longest.and_then(DVec3::try_normalize).unwrap_or(DVec3::X)
}

/// Puts what most orbits read into the picture itself, whose camera and fractal are there already;
/// only the first skip where orbits, or the reference, are too short for more.
pub fn put_near(picture: &mut Picture, datum: &Datum, skips: &Skips, places: &[Place]) {
    picture.skip = skips[0];
    let Some((radius, skip)) =
        datum.reference().and_then(|reference| near_skip(reference, datum.scale()))
    else {
        return;
    };
    let first = skip.steps as usize;
    let Some(near) = places.get(first..=first + NEAR_STEPS) else { return };
    let power = picture.fractal.power;
    let stretch = |place: &Place| power * Vec3::from_array(place.z).length().powf(power - 1.0);
    let derivative =
        near[..NEAR_STEPS].iter().map(stretch).product::<f32>() * skip.derivative.value as f32;
    let ends = picture.fractal.own_places.min(picture.fractal.iterations + 1) as usize;
    let least = LEAST_DERIVATIVE / picture.camera.hit_cone;
    if first + NEAR_STEPS < ends && derivative >= least {
        picture.fractal.least_derivative = least;
        picture.skip = packed(&skip);
        picture.near.copy_from_slice(near);
        picture.near_radius_squared = (radius * radius) as f32;
    }
}

/// What orbits near the anchor skip before the near steps, and how far from it they may be.
fn near_skip(reference: &deep::Reference, scale: f64) -> Option<(f64, deep::Skip)> {
    let skips = reference.near_skips(scale, NEAR_STEPS, &NEAR_RADII);
    let found: Vec<_> = NEAR_RADII
        .into_iter()
        .zip(skips)
        .filter_map(|(radius, skip)| Some((radius, skip?)))
        .collect();
    let wanted = found.iter().rfind(|(radius, _)| *radius <= FIRST_RADIUS)?.1.steps;
    found.into_iter().rfind(|(_, skip)| skip.steps >= wanted)
}
