//! Series approximations: polynomials that replace the first steps of all orbits near an anchor.
//!
//! A small difference is a polynomial of the offset from the anchor. With offsets q in units of the scale s,
//! `δ_m ≈ (s·J) q + ½ (s²·H)(q, q)`, with the Jacobian and the Hessian of m steps at the anchor; the
//! estimate's dr is expanded in the same way. Trial finds how many steps the polynomials may replace: they
//! are compared with orbits that take every step.

use glam::DVec3;

use super::{difference, jet::Jet, orbit::ReferencePoint};
use crate::formula::mandelbulb::power::TriplexPower;

/// Greatest relative error of the difference at the approximation's radius.
///
/// The error falls as the square of the distance from the anchor: for near points it is below f32's.
const DIFFERENCE_ERROR: f64 = 5e-5;
/// Greatest relative error of dr at the approximation's radius.
const DERIVATIVE_ERROR: f64 = 2e-4;

/// Polynomials of the offset that replace the first m steps of orbits about an anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeriesApproximation {
    /// Number of steps replaced.
    pub steps: u32,
    /// The difference to the anchor's orbit, by the offset in units of the scale.
    pub difference: [Jet; 3],
    /// dr, in units of one over the scale.
    pub derivative: Jet,
}

/// A test orbit that takes every step.
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
    /// Sign of the latitude's sine: 1 or −1.
    pub sine_sign: f64,
    /// True if the constant is the point itself (Mandelbulb), false for the Julia form.
    pub is_mandelbulb: bool,
    /// The anchor's orbit.
    pub reference_points: &'a [ReferencePoint],
    /// Scene units per unit of offset.
    pub scale: f64,
}

/// An approximation under construction, for offsets up to a radius.
struct Rung {
    series: SeriesApproximation,
    probes: Vec<Probe>,
    is_over: bool,
}

impl SeriesBuilder<'_> {
    /// The longest series approximation within each of `radii`, in units of the scale.
    pub fn within(&self, radii: &[f64]) -> Vec<SeriesApproximation> {
        let mut next = self.start();
        let rung = |radius: &f64| Rung {
            series: next,
            probes: directions().map(|way| Probe::new(way * *radius, self.scale)).collect(),
            is_over: false,
        };
        let mut rungs: Vec<_> = radii.iter().map(rung).collect();
        // No step leaves the last point.
        let last = self.reference_points.len().saturating_sub(1);
        for reference_point in &self.reference_points[..last] {
            next = self.step(&next, reference_point);
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

    /// The approximation of no steps.
    pub fn start(&self) -> SeriesApproximation {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        SeriesApproximation {
            steps: 0,
            difference: axes.map(|axis| Jet::linear(0.0, axis * self.scale)),
            derivative: Jet::constant(self.scale),
        }
    }

    /// The constant's offset over the point's offset.
    fn added(&self) -> f64 {
        if self.is_mandelbulb { self.scale } else { 0.0 }
    }

    /// The approximation with one more step, which leaves `reference_point`.
    fn step(
        &self,
        series: &SeriesApproximation,
        reference_point: &ReferencePoint,
    ) -> SeriesApproximation {
        let (raised, growth) = self.jets(reference_point, &series.difference);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let difference = [0, 1, 2]
            .map(|i| Jet { value: 0.0, ..raised[i] } + Jet::linear(0.0, axes[i] * self.added()));
        let derivative = growth * series.derivative + Jet::constant(self.added());
        SeriesApproximation { steps: series.steps + 1, difference, derivative }
    }

    fn step_probe(&self, probe: &mut Probe, reference_point: &ReferencePoint) {
        let z = reference_point.z + probe.difference;
        probe.derivative = self.power.growth(z.length()) * probe.derivative + self.added();
        probe.difference =
            difference::raised(reference_point, probe.difference, self.whole_power, self.sine_sign)
                + probe.offset * self.added();
    }

    /// zⁿ and n·r^(n−1) at the reference point + `difference`.
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

    /// True if the approximation agrees with this orbit; false for NaN, which an anchor on the axis causes.
    fn agrees(&self, series: &SeriesApproximation) -> bool {
        let foretold = DVec3::from_array(series.difference.map(|jet| jet.change(self.offset)));
        let error = (foretold - self.difference).length();
        let slope = series.derivative.value + series.derivative.gradient.dot(self.offset);
        error <= DIFFERENCE_ERROR * self.difference.length()
            && (slope - self.derivative).abs() <= DERIVATIVE_ERROR * self.derivative
    }
}

/// Unit vectors to the centres of a cube's faces and to its corners.
fn directions() -> impl Iterator<Item = DVec3> {
    let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let corners = (0..8).map(|i| {
        let sign = |bit: i32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        DVec3::new(sign(0), sign(1), sign(2)).normalize()
    });
    axes.chain(corners)
}

/// Powers by squaring, from the exponent's highest bit down.
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
