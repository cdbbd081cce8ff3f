//! The anchor's orbit as the shaders see it, and what orbits skip.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::{DMat3, DVec3};

use super::{MOST_NEAR_STEPS, Picture, Place, Skip};
use crate::{
    fractal::deep::{self, reference::MOST_PLACES, spread::norm},
    render::{form::NearSteps, space::RenderSpace},
};

/// How many skips there are.
pub const SKIPS: usize = 8;

/// Bytes of the shaders' `anchor_orbit`.
pub const ANCHOR_ORBIT_BYTES: u64 = (size_of::<Skips>() + MOST_PLACES * size_of::<Place>()) as u64;

/// How far from the anchor points may be that skip the most steps, in scales: what is in view, the
/// reach of its shadows, and what a crevice shows of the walls behind it.
pub const FIRST_RADIUS: f64 = 12.0;
/// From each radius to the next.
pub const RADII_RATIO: f64 = 8.0;

/// Behind the near steps an f32 knows places to 3e-8, and points to that over dr. It should be no more
/// than a tenth of the hit distance: orbits whose dr, in units of one over the scale, falls below this
/// over the hit cone, as where they come by the origin, follow the difference itself for longer.
const LEAST_DERIVATIVE: f64 = 3e-7;
/// Pictures of wider pixels are as exact as those of such a hit cone.
const WIDEST_CONE: f64 = 7e-4;

/// How many steps of the difference from the anchor's start may do: views of which an f32 falls short by
/// one or two digits need no more.
const FIRST_STEPS: [u32; 2] = [1, 2];
/// The anchor's dr behind those is so many times what is needed there.
const FIRST_ROOM: f64 = 5.0;

/// How many steps of the difference come behind a skip: two nearly everywhere, more where orbits come by
/// the origin soon after it. Each has pipelines of its own.
const STEPS_AFTER_SKIP: [u32; 4] = [2, 4, 6, MOST_NEAR_STEPS as u32];
/// The anchor's dr behind those is so many times what is needed there.
const ROOM_AFTER_SKIP: f64 = 4.0;
/// At so many places; behind those most orbits in view have escaped.
const ROOM_PLACES: usize = 3;
/// Radii about the anchor, in scales, within which orbits may skip steps together: 1.5 and each four times
/// the last, up to 4e5. Hardly any ray of most views goes farther.
const NEAR_RADII: usize = 10;

/// Skips, nearest to the anchor first.
pub type Skips = [Skip; SKIPS];

/// The places of an anchor's orbit; one that means nothing where there is none.
pub fn places(space: &RenderSpace) -> Arc<[Place]> {
    let nothing = [Place::zeroed()];
    let Some(reference) = space.reference() else { return Arc::new(nothing) };
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

/// What orbits skip within each of the radii of the shaders' `skips`, and within [`near_radii`]; nothing
/// where there is no anchor.
pub fn skips(space: &RenderSpace) -> (Skips, Vec<deep::Skip>) {
    let Some(reference) = space.reference() else { return ([Skip::zeroed(); SKIPS], Vec::new()) };
    let radii: [f64; SKIPS] = std::array::from_fn(|i| FIRST_RADIUS * RADII_RATIO.powi(i as i32));
    let mut found = reference.skips(space.scale(), &[&radii[..], &near_radii()].concat());
    let near = found.split_off(SKIPS);
    (std::array::from_fn(|i| packed(&found[i])), near)
}

fn near_radii() -> [f64; NEAR_RADII] {
    std::array::from_fn(|i| 1.5 * 4_f64.powi(i as i32))
}

fn packed(skip: &deep::Skip) -> Skip {
    let [x, y, z] = skip.difference;
    let vector = |part: DVec3| part.as_vec3().to_array();
    let of_each =
        |part: fn(&deep::jet::Jet) -> f64| vector(DVec3::new(part(&x), part(&y), part(&z)));
    let jacobian = DMat3::from_cols(x.gradient, y.gradient, z.gradient).transpose();
    let widest = widest_direction(jacobian);
    let stretched = jacobian * widest;
    // Of two directions across it.
    let rest_squared = 0.5 * (norm(&jacobian).powi(2) - stretched.length_squared());
    Skip {
        widest: vector(widest),
        rest: rest_squared.max(0.0).sqrt() as f32,
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
/// only the first skip where orbits, or the reference, are too short for more. `near`: of [`skips`].
pub fn put_near(
    picture: &mut Picture,
    space: &RenderSpace,
    (skips, near): (&Skips, &[deep::Skip]),
    places: &[Place],
) {
    picture.skip = skips[0];
    let Some(reference) = space.reference().filter(|reference| !reference.turns()) else { return };
    let hit_cone = f64::from(picture.camera.hit_cone);
    let least = LEAST_DERIVATIVE / hit_cone.min(WIDEST_CONE);
    let fractal = &mut picture.fractal;
    let own_places = fractal.own_places.min(fractal.iterations + 1) as usize;
    let Some(near) = Near::find(reference, space.scale(), near, own_places, least) else { return };
    fractal.near_steps = near.steps.count;
    fractal.has_skip = near.steps.has_skip.into();
    fractal.near_radius_squared = near.radius.powi(2).min(1e37) as f32;
    fractal.least_derivative = least as f32;
    // The eye is one scale from the anchor.
    let far_radius = 1.0 + deep::COARSEST_FOOTPRINT / (hit_cone * space.scale());
    fractal.far_radius = far_radius.min(1e37) as f32;
    picture.skip = packed(&near.skip);
    let passed = &places[near.skip.steps as usize..][..=near.steps.count as usize];
    picture.near[..passed.len()].copy_from_slice(passed);
}

/// What orbits near the anchor do together before they go on in plain f32.
struct Near {
    steps: NearSteps,
    /// Of no steps where there is none.
    skip: deep::Skip,
    /// How far from the anchor their points may be, in scales.
    radius: f64,
}

impl Near {
    /// The fewest steps behind which the anchor's dr is far enough above `least`; behind a skip, those
    /// that reach as far as [`FIRST_RADIUS`] where any do.
    fn find(
        reference: &deep::Reference,
        scale: f64,
        skips: &[deep::Skip],
        own_places: usize,
        least: f64,
    ) -> Option<Self> {
        let derivatives = reference.derivatives(scale, own_places);
        // Some steps on as well: other orbits come by the origin where the anchor's does.
        let room = |behind: u32| {
            let followed = derivatives.get(behind as usize..)?.first_chunk::<ROOM_PLACES>()?;
            Some(followed.iter().copied().fold(f64::INFINITY, f64::min) / least)
        };
        let first = FIRST_STEPS
            .into_iter()
            .find(|&count| room(count).is_some_and(|room| room >= FIRST_ROOM));
        if let Some(count) = first {
            let steps = NearSteps { count, has_skip: false };
            return Some(Self { steps, skip: reference.no_skip(scale), radius: f64::INFINITY });
        }
        let widest = |count: u32| {
            let found = skips.iter().zip(near_radii()).rfind(|(skip, _)| {
                room(skip.steps + count).is_some_and(|room| room >= ROOM_AFTER_SKIP)
            });
            let (skip, radius) = found?;
            Some(Self { steps: NearSteps { count, has_skip: true }, skip: *skip, radius })
        };
        let found: Vec<_> = STEPS_AFTER_SKIP.into_iter().filter_map(widest).collect();
        let most = found.iter().map(|near| near.radius).fold(0.0, f64::max);
        found.into_iter().find(|near| near.radius >= most.min(FIRST_RADIUS))
    }
}
