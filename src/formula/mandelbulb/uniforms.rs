//! Packs the uniforms of the Mandelbulb's kernels.
//!
//! They are the fractal, the reference orbit and its series approximations. `types.wgsl` declares the
//! WGSL twins.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::{
    deep::{self, Reference},
    estimator::{self, SIDEWAYS_MAX},
    parameters::{MANDELBULB, Mandelbulb, STEP_LIMITS},
    variant::{MAX_NEAR_STEPS, NearSteps, Steps, Variant},
};
use crate::{
    formula::{
        FormulaRef, Kernel, Packed, PackedFor,
        march::COARSEST_FOOTPRINT,
        recurrence::norm,
        trap::{MAX_TRAP, Trap},
    },
    gpu::host_shared::{Array, HostShared, bytes_of_all, host_shared},
};

/// Number of reference points that the near steps use.
pub const NEAR_POINTS: usize = MAX_NEAR_STEPS + 1;
/// Number of series approximations in `anchor_orbit`.
pub const SERIES: usize = 8;

host_shared! {
    /// Name, size in bytes and fields of every struct here.
    HOST_SHARED;
    /// The set.
    Fractal {
        /// The Julia form's constant.
        julia_constant: [f32; 3],
        /// Exponent n.
        power: f32,
        /// Most orbit steps.
        iterations: u32,
        /// Radius beyond which an orbit is not followed, scene units.
        bailout: f32,
        /// 1 for the Julia form.
        julia: u32,
        /// Sign of the sine term.
        z_sign: f32,
        /// Longest safe step of a ray, in units of render space.
        max_step: f32,
        /// Derivatives are clamped to this.
        derivative_max: f32,
        /// Binary logarithm of the bailout.
        log2_bailout: f32,
        /// Orbits with a dr below this, in 1 / scale, use the careful estimate.
        min_derivative: f32,
        /// Origin of render space, in scene units.
        anchor: [f32; 3],
        /// Unit of render space, in scene units.
        scale: f32,
        /// Points of the reference orbit; 0 without an anchor.
        reference_points: u32,
        /// Number of points of the anchor's own orbit among them.
        own_points: u32,
        /// Index of the reference point from which orbits restart.
        restart: u32,
        /// Squared radius about the anchor within which orbits use the near steps; 0 if none do.
        near_radius_squared: f32,
        /// Distance from the anchor, in scales, beyond which plain f32 resolves points.
        far_radius: f32,
        /// Natural logarithm of [`estimator::escape_radius`].
        log_escape_radius: f32,
    }
    /// Replaces the first steps of all orbits near the anchor: see [`super::deep::series`].
    SeriesApproximation {
        /// First derivatives of the difference by the offset's x.
        along_x: [f32; 3],
        /// Number of orbit steps that the series replaces.
        steps: u32,
        /// First derivatives by the offset's y.
        along_y: [f32; 3],
        /// dr at the anchor, in units of one over the scale.
        derivative: f32,
        /// First derivatives by the offset's z.
        along_z: [f32; 3],
        /// Second derivatives.
        along_xx: [f32; 3],
        /// Second derivatives.
        along_yy: [f32; 3],
        /// Second derivatives.
        along_zz: [f32; 3],
        /// Second derivatives.
        along_xy: [f32; 3],
        /// Second derivatives.
        along_yz: [f32; 3],
        /// Second derivatives.
        along_zx: [f32; 3],
        /// First derivatives of dr.
        derivative_gradient: [f32; 3],
        /// The direction that the replaced steps stretch most, a unit vector.
        widest: [f32; 3],
        /// The norm of the Jacobian across `widest`.
        rest: f32,
        /// Least distances of the replaced steps from the colour layers' orbit traps.
        traps: [f32; 2],
    }
    /// A point of the reference orbit.
    ReferencePoint {
        /// z.
        z: [f32; 3],
        /// |x + iy|.
        rho: f32,
        /// (x + iy)/ρ.
        rotor: [f32; 2],
    }
    /// The formula's part of a frame's uniforms.
    FormulaUniforms {
        /// The set.
        fractal: Fractal,
        /// The series approximation that precedes the near steps.
        series: SeriesApproximation,
        /// The reference points of the near steps.
        near: Array<ReferencePoint, NEAR_POINTS>,
        /// The direction that orbits in view stretch most, a unit vector: it stands for all directions of a cone.
        cone_direction: [f32; 3],
    }
}

/// Radius of the first series approximation, in scales.
///
/// It covers what is in view, the reach of its shadows, and the walls visible behind a crevice.
pub const FIRST_RADIUS: f64 = 12.0;
/// Ratio of a series approximation's radius to the radius before.
pub const RADII_RATIO: f64 = 8.0;

/// Least dr after the near steps, over the hit cone, in 1 / scale.
///
/// After the near steps, an f32 stores an orbit position to 3e-8, so it resolves points to 3e-8 over dr. That
/// should be at most a thirtieth of the hit distance: where the steps that are left stretch unevenly, errors grow more
/// than dr. Orbits whose dr falls below this over the hit cone,
/// such as orbits that pass the origin, follow the difference for more steps.
const MIN_DERIVATIVE: f64 = 1e-6;
/// Widest hit cone in this rule: pictures of wider pixels are as exact as with this hit cone.
const WIDEST_CONE: f64 = 7e-4;

/// Counts of near steps without a series approximation; the first that suffices is used.
///
/// They suffice for views where an f32 lacks one or two digits.
const FIRST_STEPS: [u32; 2] = [1, 2];
/// Least dr at the anchor after those steps, as a multiple of the required dr.
const FIRST_ROOM: f64 = 5.0;

/// Counts of near steps after a series approximation; each count has its own pipelines.
///
/// Two suffice nearly everywhere; views whose orbits pass the origin soon afterwards need more.
const STEPS_AFTER_SERIES: [u32; 4] = [2, 4, 6, MAX_NEAR_STEPS as u32];
/// Least dr at the anchor after those steps, as a multiple of the required dr.
const ROOM_AFTER_SERIES: f64 = 4.0;
/// Number of reference points over which dr must be that large; after them most orbits in view have escaped.
const ROOM_POINTS: usize = 3;
/// Number of radii that are tried for the picture's own series approximation.
///
/// The radii are 1.5 scales, then each four times the last, up to 4e5. Few rays go farther.
const NEAR_RADII: usize = 10;

/// Series approximations, nearest to the anchor first.
type SeriesList = Array<SeriesApproximation, SERIES>;

/// Packs the uniforms of a view of `mandelbulb` and selects its kernel.
pub fn pack(mandelbulb: &Mandelbulb, view: &PackedFor<'_>) -> Packed {
    let reference = view.reference.and_then(|reference| deep::reference_of(reference));
    let mut uniforms =
        FormulaUniforms { fractal: fractal(mandelbulb, view, reference), ..Default::default() };
    let power = mandelbulb.integer_power().unwrap_or(0);
    let Some(reference) = reference else {
        let variant = Variant { power, steps: Steps::Plain };
        return packed_with(variant, &uniforms, Arc::new([]));
    };
    let points: Vec<_> = reference.points().iter().map(reference_point).collect();
    let (series, near) = series(reference, view);
    uniforms.series = series[0];
    let parting = reference.parting_jacobian(view.scale);
    uniforms.cone_direction = widest_direction(parting).as_vec3().to_array();
    let steps = if reference.rotates() {
        Steps::RotatingFrame
    } else {
        Steps::Perturbed(put_near(&mut uniforms, view, reference, &near, &points))
    };
    let table = [series.to_bytes(), bytes_of_all(&points)].concat();
    packed_with(Variant { power, steps }, &uniforms, table.into())
}

fn packed_with(variant: Variant, uniforms: &FormulaUniforms, table: Arc<[u8]>) -> Packed {
    let formula = FormulaRef(&MANDELBULB);
    let kernel = Kernel { formula, variant: variant.number() };
    let step_limits = variant.has_jacobian_steps().then_some(STEP_LIMITS);
    let series_steps = if variant.has_jacobian_steps() { uniforms.series.steps } else { 0 };
    Packed { kernel, uniforms: uniforms.to_bytes(), table, step_limits, series_steps }
}

fn fractal(set: &Mandelbulb, view: &PackedFor<'_>, reference: Option<&Reference>) -> Fractal {
    let anchor = reference.map_or(DVec3::ZERO, |reference| reference.anchor().to_dvec3());
    // The next derivative is at most this many times the current one, plus one.
    let stretch_max = SIDEWAYS_MAX * set.power * set.bailout.powf(set.power - 1.0);
    let max_step = estimator::max_step(set, view.bounding_radius);
    Fractal {
        julia_constant: set.julia_constant.map(|v| v as f32),
        power: set.power as f32,
        iterations: view.iterations,
        bailout: set.bailout as f32,
        julia: u32::from(set.julia),
        z_sign: set.sine.sign() as f32,
        max_step: (max_step / view.scale).min(1e30) as f32,
        derivative_max: (1e38 / stretch_max).min(1e36) as f32,
        log2_bailout: set.bailout.log2() as f32,
        min_derivative: 0.0,
        anchor: anchor.as_vec3().to_array(),
        scale: view.scale as f32,
        reference_points: reference.map_or(0, |reference| reference.points().len() as u32),
        own_points: reference.map_or(0, |reference| reference.own_points() as u32),
        restart: reference.map_or(0, |reference| reference.restart() as u32),
        near_radius_squared: 0.0,
        far_radius: f32::MAX,
        log_escape_radius: estimator::escape_radius(set).ln() as f32,
    }
}

fn reference_point(point: &deep::ReferencePoint) -> ReferencePoint {
    ReferencePoint {
        z: point.z.as_vec3().to_array(),
        rho: point.rho as f32,
        rotor: point.rotor.as_vec2().to_array(),
    }
}

/// Series approximations for `anchor_orbit`, and one within each of [`near_radii`].
fn series(
    reference: &Reference,
    view: &PackedFor<'_>,
) -> (SeriesList, Vec<deep::SeriesApproximation>) {
    let radii: [f64; SERIES] = std::array::from_fn(|i| FIRST_RADIUS * RADII_RATIO.powi(i as i32));
    let mut found = reference.series(view.scale, &[&radii[..], &near_radii()].concat());
    let near = found.split_off(SERIES);
    (Array(std::array::from_fn(|i| packed(&found[i], reference, &view.traps))), near)
}

/// Least distances of the reference orbit's first `steps` points, after its start, from the traps.
fn nearest(reference: &Reference, steps: u32, traps: &[Option<Trap>; 2]) -> [f32; 2] {
    let points = reference.points().iter().skip(1).take(steps as usize);
    let least = points.fold([MAX_TRAP; 2], |least, point| {
        std::array::from_fn(|i| match &traps[i] {
            Some(trap) => least[i].min(trap.distance(point.z)),
            None => least[i],
        })
    });
    least.map(|least| least as f32)
}

fn near_radii() -> [f64; NEAR_RADII] {
    std::array::from_fn(|i| 1.5 * 4_f64.powi(i as i32))
}

fn packed(
    series: &deep::SeriesApproximation,
    reference: &Reference,
    traps: &[Option<Trap>; 2],
) -> SeriesApproximation {
    let [x, y, z] = series.difference;
    let vector = |part: DVec3| part.as_vec3().to_array();
    let of_each =
        |part: fn(&deep::jet::Jet) -> f64| vector(DVec3::new(part(&x), part(&y), part(&z)));
    let jacobian = DMat3::from_cols(x.gradient, y.gradient, z.gradient).transpose();
    let widest = widest_direction(jacobian);
    let stretched = jacobian * widest;
    // The mean over two directions across `widest`.
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
        traps: nearest(reference, series.steps, traps),
    }
}

/// The direction that `map` stretches most, a unit vector; any direction if `map` is zero.
fn widest_direction(map: DMat3) -> DVec3 {
    // Repeated squaring of mapᵀ·map converges to the projection onto that direction.
    let mut power = map.transpose() * map;
    for _ in 0..16 {
        power *= power.to_cols_array().into_iter().fold(0.0, f64::max).recip();
        power *= power;
    }
    let columns = [power.x_axis, power.y_axis, power.z_axis];
    let longest = columns.into_iter().max_by(|u, v| u.length().total_cmp(&v.length()));
    longest.and_then(DVec3::try_normalize).unwrap_or(DVec3::X)
}

/// Stores the near steps' series approximation and reference points in the uniforms.
///
/// Returns a count of 0, and stores nothing, if the orbits or the reference orbit are too short for near
/// steps. `near` comes from [`series`].
fn put_near(
    uniforms: &mut FormulaUniforms,
    view: &PackedFor<'_>,
    reference: &Reference,
    near: &[deep::SeriesApproximation],
    points: &[ReferencePoint],
) -> NearSteps {
    let hit_cone = f64::from(view.hit_cone);
    let least = MIN_DERIVATIVE / hit_cone.min(WIDEST_CONE);
    let fractal = &mut uniforms.fractal;
    let own_points = fractal.own_points.min(fractal.iterations + 1) as usize;
    let Some(near) = Near::find(reference, view.scale, near, own_points, least) else {
        return NearSteps { count: 0, has_series: false };
    };
    fractal.near_radius_squared = near.radius.powi(2).min(1e37) as f32;
    fractal.min_derivative = least as f32;
    // The eye is one scale from the anchor.
    let far_radius = 1.0 + COARSEST_FOOTPRINT / (hit_cone * view.scale);
    fractal.far_radius = far_radius.min(1e37) as f32;
    uniforms.series = packed(&near.series, reference, &view.traps);
    let passed = &points[near.series.steps as usize..][..=near.steps.count as usize];
    uniforms.near[..passed.len()].copy_from_slice(passed);
    near.steps
}

/// The near steps of a view, and the series approximation before them.
struct Near {
    steps: NearSteps,
    /// Has zero steps if `steps.has_series` is false.
    series: deep::SeriesApproximation,
    /// Radius about the anchor of the points that use the near steps, in scales.
    radius: f64,
}

impl Near {
    /// Finds the fewest near steps after which the anchor's dr suffices.
    ///
    /// With a series approximation, step counts that reach [`FIRST_RADIUS`] have priority. The required dr is
    /// `least`, in units of one over `scale`.
    fn find(
        reference: &Reference,
        scale: f64,
        series: &[deep::SeriesApproximation],
        own_points: usize,
        least: f64,
    ) -> Option<Self> {
        let derivatives = reference.derivatives(scale, own_points);
        // Includes some later steps: other orbits pass the origin at the same steps as the anchor's.
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
