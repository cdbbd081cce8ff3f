//! The anchor's orbit and its series approximations, as the shaders read them.

use std::sync::Arc;

use bytemuck::Zeroable;
use glam::{DMat3, DVec3};

use super::{FrameUniforms, MOST_NEAR_STEPS, ReferencePoint, SeriesApproximation};
use crate::{
    fractal::deep::{self, jacobian::norm, reference::MOST_REFERENCE_POINTS},
    render::{pipeline_key::NearSteps, space::RenderSpace},
};

/// How many series approximations `anchor_orbit` holds.
pub const SERIES: usize = 8;

/// Bytes of the shaders' `anchor_orbit`.
pub const ANCHOR_ORBIT_BYTES: u64 =
    (size_of::<SeriesList>() + MOST_REFERENCE_POINTS * size_of::<ReferencePoint>()) as u64;

/// Radius of the first of them, in scales: what is in view, the reach of its shadows, and what a crevice
/// shows of the walls behind it.
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

/// Near steps behind a series approximation: two nearly everywhere, more where orbits pass the origin soon
/// after. Each count has pipelines of its own.
const STEPS_AFTER_SERIES: [u32; 4] = [2, 4, 6, MOST_NEAR_STEPS as u32];
/// The anchor's dr behind those is so many times what is needed there.
const ROOM_AFTER_SERIES: f64 = 4.0;
/// At so many places; behind those most orbits in view have escaped.
const ROOM_POINTS: usize = 3;
/// Radii that are tried for the picture's own series approximation, in scales: 1.5 and each four times the
/// last, up to 4e5. Hardly any ray of most views goes farther.
const NEAR_RADII: usize = 10;

/// Skips, nearest to the anchor first.
pub type SeriesList = [SeriesApproximation; SERIES];

/// The places of an anchor's orbit; one that means nothing where there is none.
pub fn reference_points(space: &RenderSpace) -> Arc<[ReferencePoint]> {
    let nothing = [ReferencePoint::zeroed()];
    let Some(reference) = space.reference() else { return Arc::new(nothing) };
    reference.points().iter().map(reference_point).collect()
}

fn reference_point(reference_point: &deep::ReferencePoint) -> ReferencePoint {
    ReferencePoint {
        z: reference_point.z.as_vec3().to_array(),
        rho: reference_point.rho as f32,
        rotor: reference_point.rotor.as_vec2().to_array(),
        unused: [0; 2],
    }
}

/// Series approximations for `anchor_orbit`, and within each of [`near_radii`]; none without an anchor.
pub fn series(space: &RenderSpace) -> (SeriesList, Vec<deep::SeriesApproximation>) {
    let Some(reference) = space.reference() else {
        return ([SeriesApproximation::zeroed(); SERIES], Vec::new());
    };
    let radii: [f64; SERIES] = std::array::from_fn(|i| FIRST_RADIUS * RADII_RATIO.powi(i as i32));
    let mut found = reference.series(space.scale(), &[&radii[..], &near_radii()].concat());
    let near = found.split_off(SERIES);
    (std::array::from_fn(|i| packed(&found[i])), near)
}

fn near_radii() -> [f64; NEAR_RADII] {
    std::array::from_fn(|i| 1.5 * 4_f64.powi(i as i32))
}

fn packed(series: &deep::SeriesApproximation) -> SeriesApproximation {
    let [x, y, z] = series.difference;
    let vector = |part: DVec3| part.as_vec3().to_array();
    let of_each =
        |part: fn(&deep::jet::Jet) -> f64| vector(DVec3::new(part(&x), part(&y), part(&z)));
    let jacobian = DMat3::from_cols(x.gradient, y.gradient, z.gradient).transpose();
    let widest = widest_direction(jacobian);
    let stretched = jacobian * widest;
    // Of two directions across it.
    let rest_squared = 0.5 * (norm(&jacobian).powi(2) - stretched.length_squared());
    SeriesApproximation {
        widest: vector(widest),
        rest: rest_squared.max(0.0).sqrt() as f32,
        along_x: of_each(|jet| jet.gradient.x),
        steps: series.steps,
        along_y: of_each(|jet| jet.gradient.y),
        derivative: series.derivative.value as f32,
        along_z: of_each(|jet| jet.gradient.z),
        along_xx: of_each(|jet| jet.pure.x),
        along_yy: of_each(|jet| jet.pure.y),
        along_zz: of_each(|jet| jet.pure.z),
        along_xy: of_each(|jet| jet.mixed.x),
        along_yz: of_each(|jet| jet.mixed.y),
        along_zx: of_each(|jet| jet.mixed.z),
        derivative_gradient: vector(series.derivative.gradient),
        traps_squared: vector(series.traps_squared),
        ..SeriesApproximation::zeroed()
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
/// only the first approximation where orbits, or the reference, are too short for more. `near`: of
/// [`series`].
pub fn put_near(
    picture: &mut FrameUniforms,
    space: &RenderSpace,
    (series, near): (&SeriesList, &[deep::SeriesApproximation]),
    reference_points: &[ReferencePoint],
) {
    picture.series = series[0];
    let Some(reference) = space.reference().filter(|reference| !reference.rotates()) else {
        return;
    };
    let hit_cone = f64::from(picture.camera.hit_cone);
    let least = LEAST_DERIVATIVE / hit_cone.min(WIDEST_CONE);
    let fractal = &mut picture.fractal;
    let own_points = fractal.own_points.min(fractal.iterations + 1) as usize;
    let Some(near) = Near::find(reference, space.scale(), near, own_points, least) else { return };
    fractal.near_steps = near.steps.count;
    fractal.has_series = near.steps.has_series.into();
    fractal.near_radius_squared = near.radius.powi(2).min(1e37) as f32;
    fractal.least_derivative = least as f32;
    // The eye is one scale from the anchor.
    let far_radius = 1.0 + deep::COARSEST_FOOTPRINT / (hit_cone * space.scale());
    fractal.far_radius = far_radius.min(1e37) as f32;
    picture.series = packed(&near.series);
    let passed = &reference_points[near.series.steps as usize..][..=near.steps.count as usize];
    picture.near[..passed.len()].copy_from_slice(passed);
}

/// What orbits near the anchor do together before they go on in plain f32.
struct Near {
    steps: NearSteps,
    /// Of no steps where there is none.
    series: deep::SeriesApproximation,
    /// How far from the anchor their points may be, in scales.
    radius: f64,
}

impl Near {
    /// The fewest steps behind which the anchor's dr is far enough above `least`; behind a series, those
    /// that reach as far as [`FIRST_RADIUS`] where any do.
    fn find(
        reference: &deep::Reference,
        scale: f64,
        series: &[deep::SeriesApproximation],
        own_points: usize,
        least: f64,
    ) -> Option<Self> {
        let derivatives = reference.derivatives(scale, own_points);
        // Some steps on as well: other orbits come by the origin where the anchor's does.
        let room = |behind: u32| {
            let followed = derivatives.get(behind as usize..)?.first_chunk::<ROOM_POINTS>()?;
            Some(followed.iter().copied().fold(f64::INFINITY, f64::min) / least)
        };
        let first = FIRST_STEPS
            .into_iter()
            .find(|&count| room(count).is_some_and(|room| room >= FIRST_ROOM));
        if let Some(count) = first {
            let steps = NearSteps { count, has_series: false };
            return Some(Self {
                steps,
                series: reference.empty_series(scale),
                radius: f64::INFINITY,
            });
        }
        let widest = |count: u32| {
            let found = series.iter().zip(near_radii()).rfind(|(series, _)| {
                room(series.steps + count).is_some_and(|room| room >= ROOM_AFTER_SERIES)
            });
            let (series, radius) = found?;
            Some(Self { steps: NearSteps { count, has_series: true }, series: *series, radius })
        };
        let found: Vec<_> = STEPS_AFTER_SERIES.into_iter().filter_map(widest).collect();
        let most = found.iter().map(|near| near.radius).fold(0.0, f64::max);
        found.into_iter().find(|near| near.radius >= most.min(FIRST_RADIUS))
    }
}
