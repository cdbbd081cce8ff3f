//! Series approximation: the first steps of all orbits near an anchor at once. While a difference is small,
//! it is a polynomial of the offset from the anchor.
//!
//! With offsets q in units of the scale s, `δ_m ≈ (s·J) q + ½ (s²·H)(q, q)`, the Jacobian and the
//! Hessian of m steps at the anchor, and the estimate's derivative likewise. How many steps may be
//! covered is found by trial: the polynomials are compared with orbits that take every step.

use glam::DVec3;

use super::{difference, jet::Jet, orbit::ReferencePoint};
use crate::fractal::power::TriplexPower;

/// Largest relative error of the difference at the approximation's radius.
/// It falls as the square of the distance from the anchor: nearer points lose what f32 steps lose.
const DIFFERENCE_ERROR: f64 = 5e-5;
/// The same of the derivative.
const DERIVATIVE_ERROR: f64 = 2e-4;

/// What m steps of the orbits about an anchor make of their offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesApproximation {
    /// How many steps.
    pub steps: u32,
    /// The difference to the anchor's orbit, by the offset in units of the scale.
    pub difference: [Jet; 3],
    /// dr, in units of one over the scale.
    pub derivative: Jet,
    /// Squares of the least distances of the points passed, after the first, from the origin, the
    /// z axis and the plane z = 0.
    pub traps_squared: DVec3,
}

/// An orbit that goes every step, beside the anchor's.
struct Probe {
    offset: DVec3,
    difference: DVec3,
    derivative: f64,
}

/// Builds the series approximations of a reference orbit for a view.
pub struct SeriesBuilder<'a> {
    /// zⁿ.
    pub power: TriplexPower,
    /// The exponent n.
    pub whole_power: u32,
    /// The sine's sign.
    pub sine_sign: f64,
    /// The constant moves with the point.
    pub is_mandelbulb: bool,
    /// The anchor's orbit.
    pub reference_points: &'a [ReferencePoint],
    /// Scene units of an offset of one.
    pub scale: f64,
}

/// An approximation under construction, for offsets up to a radius.
struct Rung {
    series: SeriesApproximation,
    probes: Vec<Probe>,
    is_over: bool,
}

impl SeriesBuilder<'_> {
    /// The longest approximation within each of `radii`, in units of the scale.
    pub fn within(&self, radii: &[f64]) -> Vec<SeriesApproximation> {
        let mut next = self.start();
        let rung = |radius: &f64| Rung {
            series: next,
            probes: directions().map(|way| Probe::new(way * *radius, self.scale)).collect(),
            is_over: false,
        };
        let mut rungs: Vec<_> = radii.iter().map(rung).collect();
        // The last place has no step.
        for (reference_point, reached) in
            self.reference_points.iter().zip(&self.reference_points[1..])
        {
            next = self.step(&next, reference_point, reached);
            for rung in rungs.iter_mut().filter(|rung| !rung.is_over) {
                for probe in &mut rung.probes {
                    self.step_probe(probe, reference_point);
                }
                rung.is_over = !rung.probes.iter().all(|probe| probe.agrees(&next));
                if !rung.is_over {
                    rung.series = next;
                }
            }
            if rungs.iter().all(|rung| rung.is_over) {
                break;
            }
        }
        rungs.into_iter().map(|rung| rung.series).collect()
    }

    /// No steps at all.
    pub fn start(&self) -> SeriesApproximation {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        SeriesApproximation {
            steps: 0,
            difference: axes.map(|axis| Jet::linear(0.0, axis * self.scale)),
            derivative: Jet::constant(self.scale),
            traps_squared: DVec3::splat(4.0),
        }
    }

    /// What a constant's offset adds, as a part of it.
    fn added(&self) -> f64 {
        if self.is_mandelbulb { self.scale } else { 0.0 }
    }

    /// One more step, from `reference_point` to `reached`.
    fn step(
        &self,
        series: &SeriesApproximation,
        reference_point: &ReferencePoint,
        reached: &ReferencePoint,
    ) -> SeriesApproximation {
        let (raised, growth) = self.jets(reference_point, &series.difference);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let difference = [0, 1, 2]
            .map(|i| Jet { value: 0.0, ..raised[i] } + Jet::linear(0.0, axes[i] * self.added()));
        let derivative = growth * series.derivative + Jet::constant(self.added());
        let z = reached.z;
        let seen = DVec3::new(z.length_squared(), reached.rho * reached.rho, z.z * z.z);
        SeriesApproximation {
            steps: series.steps + 1,
            difference,
            derivative,
            traps_squared: series.traps_squared.min(seen),
        }
    }

    fn step_probe(&self, probe: &mut Probe, reference_point: &ReferencePoint) {
        let z = reference_point.z + probe.difference;
        probe.derivative = self.power.growth(z.length()) * probe.derivative + self.added();
        probe.difference =
            difference::raised(reference_point, probe.difference, self.whole_power, self.sine_sign)
                + probe.offset * self.added();
    }

    /// zⁿ and n·r^(n−1) about a place, whose coordinates change by `difference`.
    fn jets(&self, reference_point: &ReferencePoint, difference: &[Jet; 3]) -> ([Jet; 3], Jet) {
        let [x, y, z] = [0, 1, 2].map(|i| difference[i] + Jet::constant(reference_point.z[i]));
        let n = self.whole_power as i32;
        let a = x * x + y * y;
        let rho = a.sqrt();
        let inverse = rho.recip();
        let w = complex_power([rho, z], self.whole_power);
        let u = complex_power([x * inverse, y * inverse], self.whole_power);
        let growth = (a + z * z).sqrt().powi(n - 1) * f64::from(n);
        ([w[0] * u[0], w[0] * u[1], w[1] * self.sine_sign], growth)
    }
}

impl Probe {
    fn new(offset: DVec3, scale: f64) -> Self {
        Self { offset, difference: offset * scale, derivative: scale }
    }

    /// True if an approximation agrees with this orbit: not where anything is NaN, as about an anchor on the
    /// axis.
    fn agrees(&self, series: &SeriesApproximation) -> bool {
        let foretold = DVec3::from_array(series.difference.map(|jet| jet.change(self.offset)));
        let error = (foretold - self.difference).length();
        let slope = series.derivative.value + series.derivative.gradient.dot(self.offset);
        error <= DIFFERENCE_ERROR * self.difference.length()
            && (slope - self.derivative).abs() <= DERIVATIVE_ERROR * self.derivative
    }
}

/// To the faces' centres and the corners of a cube, unit vectors.
fn directions() -> impl Iterator<Item = DVec3> {
    let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let corners = (0..8).map(|i| {
        let sign = |bit: i32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        DVec3::new(sign(0), sign(1), sign(2)).normalize()
    });
    axes.chain(corners)
}

/// By squaring, from the exponent's highest bit down.
fn complex_power([re, im]: [Jet; 2], n: u32) -> [Jet; 2] {
    let (mut x, mut y) = (re, im);
    for bit in (0..n.ilog2()).rev() {
        (x, y) = ((x - y) * (x + y), x * y * 2.0);
        if n >> bit & 1 == 1 {
            (x, y) = (x * re - y * im, x * im + y * re);
        }
    }
    [x, y]
}
