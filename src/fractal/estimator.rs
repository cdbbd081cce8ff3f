//! How far it is to the fractal (thesis Algorithm 1, with the line for z.y that its print leaves out).
//!
//! The orbit starts at z₀ = p and steps z ← zⁿ + c, c being the point itself (Mandelbulb) or a
//! constant (Julia form). A scalar stands in for the Jacobian: dr ← n·r^(n−1)·dr + 1, without
//! the + 1 for the Julia form, whose c does not move with the point. The estimate is
//! `½ · ln r · r / dr`. It is zero where the orbit ends with r ≤ 1: inside, or too near to say.
//!
//! dr is no bound of the Jacobian: two of the power's singular values are n·r^(n−1), but the third,
//! along the parallels, is n·|Re wⁿ|/ρ, larger near the polar axis. Steps of the whole estimate pass
//! thin walls where an orbit came by there. So a second scalar dg grows by the largest of the
//! three, which is far too careful away from the axis: a ray steps by several times that estimate
//! ([`step_factor`]), and no more than the first one. `tests/cpu/fractal/properties.rs` counts what rays still
//! pass, against a march with far shorter steps.
//!
//! At power 2, and now and then at 3, orbits that come by the axis early on make hairs: there the
//! estimate falls from several hit distances below one and back within thousandths of it.
//! The Jacobian's own norm knows of them, but as an estimate it would draw them as thick as pixels,
//! the polar axis among them, most of it where the set is far away. So such rays go on unless they stay
//! near ([`DistanceField::needs_hit_check`]).

use std::cell::RefCell;

use glam::DVec3;

use super::{
    march::{DistanceField, Estimate},
    power::TriplexPower,
};
use crate::scene::Fractal;

/// How much of the bounding sphere's radius is added to it, to be safe from rounding.
const BOUNDING_MARGIN: f64 = 0.01;
/// How much more than n·r^(n−1) a step of the orbit may be taken to stretch along the parallels: at
/// the poles it would stop every ray.
pub const SIDEWAYS_MAX: f64 = 10.0;
/// A step over the estimate by the Jacobian's norm (Frobenius): half of it reaches the surface from
/// 10³² times as far in about a hundred steps.
const JACOBIAN_STEP_FACTOR: f64 = 0.5;
/// The same as [`SIDEWAYS_MAX`], of the Jacobian that deep rays step by.
pub const DEEP_SIDEWAYS_MAX: f64 = 30.0;
/// The estimate of lower powers dips; see the module's head.
const HIT_CHECK_BELOW: f64 = 4.0;
/// Keeps the estimate finite where a Julia orbit passes the origin and dr vanishes.
const LEAST_DERIVATIVE: f64 = 1e-30;

/// Sets whose bounding radius is remembered: views and movements ask for two or three at a time.
const RADII_KEPT: usize = 4;

thread_local! {
    /// The bounding radii that were found last, newest first.
    static RADII: RefCell<Vec<(Fractal, f64)>> = const { RefCell::new(Vec::new()) };
}

/// One fractal, ready to be measured. Cheap to copy; make a new one when the fractal changes, as
/// often as one is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    power: TriplexPower,
    iterations: u32,
    bailout: f64,
    /// The constant of the Julia form; none for the Mandelbulb, which adds the point itself.
    julia_constant: Option<DVec3>,
    step_factor: f64,
    max_step: f64,
    bounding_radius: f64,
    needs_hit_check: bool,
}

impl Estimator {
    /// Prepares `fractal`, which must be within its ranges.
    pub fn new(fractal: &Fractal) -> Self {
        let julia_constant = fractal.julia.then(|| DVec3::from_array(fractal.julia_constant));
        let bounding_radius = remembered_radius(fractal);
        Self {
            power: TriplexPower::new(fractal),
            iterations: fractal.iterations,
            bailout: fractal.bailout,
            julia_constant,
            step_factor: step_factor(fractal),
            max_step: max_step(fractal, bounding_radius),
            bounding_radius,
            needs_hit_check: fractal.power < HIT_CHECK_BELOW,
        }
    }

    /// The estimated distance from `point` to the fractal, in scene units: at least zero, and
    /// zero inside. It is no strict bound: a ray steps by [`Self::estimate`].
    pub fn distance(&self, point: DVec3) -> f64 {
        self.estimate(point).distance
    }

    /// The estimated distance, and the step that a ray may take; see the module's head.
    pub fn estimate(&self, point: DVec3) -> Estimate {
        let (added, dr_added) = match self.julia_constant {
            Some(constant) => (constant, 0.0),
            None => (point, 1.0),
        };
        let (mut z, mut r, mut dr, mut dg) = (point, point.length(), 1.0, 1.0);
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            let (raised, growth) = (self.power.apply(z), self.power.growth(r));
            let sideways = self.power.sideways_growth(z, raised);
            dr = growth * dr + dr_added;
            dg = sideways.max(growth).min(SIDEWAYS_MAX * growth) * dg + dr_added;
            z = raised + added;
            r = z.length();
        }
        self.estimate_from(r, dr, self.step_factor / dg.max(LEAST_DERIVATIVE))
    }

    /// The same of an orbit beside a reference, whose Jacobian is carried along: over the many
    /// steps of a deep view dg grows far past it, and a ray would creep.
    pub(super) fn estimate_along(&self, mut orbit: impl Orbit) -> Estimate {
        let (mut r, mut dr) = (orbit.z().length(), 1.0);
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            dr = self.power.growth(r) * dr + self.constant_derivative();
            orbit.step(&self.power);
            r = orbit.z().length();
        }
        self.estimate_from(r, dr, JACOBIAN_STEP_FACTOR / orbit.norm().max(LEAST_DERIVATIVE))
    }

    /// How the constant moves with the point.
    pub(super) fn constant_derivative(&self) -> f64 {
        if self.julia_constant.is_some() { 0.0 } else { 1.0 }
    }

    /// At the end of an orbit: `careful` is the step over the height.
    fn estimate_from(&self, r: f64, dr: f64, careful: f64) -> Estimate {
        if r <= 1.0 {
            return Estimate { distance: 0.0, step: 0.0 };
        }
        let height = 0.5 * r.ln() * r;
        let distance = height / dr.max(LEAST_DERIVATIVE);
        Estimate { distance, step: (careful * height).min(distance).min(self.max_step) }
    }

    /// The longest step a ray may take, in scene units; see [`max_step`].
    pub fn max_step(&self) -> f64 {
        self.max_step
    }

    /// The radius of a sphere about the origin that holds the whole fractal; see [`bounding_radius`].
    pub fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

/// An orbit under way.
pub(super) trait Orbit {
    /// Where it is.
    fn z(&self) -> DVec3;

    /// Goes on from there.
    fn step(&mut self, power: &TriplexPower);

    /// The Jacobian's norm: how far the place moves with the point.
    fn norm(&self) -> f64;
}

impl DistanceField for Estimator {
    fn distance(&self, point: DVec3) -> f64 {
        Estimator::distance(self, point)
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        Estimator::estimate(self, point)
    }

    fn needs_hit_check(&self) -> bool {
        self.needs_hit_check
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

/// How many times the estimate by dg a ray may step. Measured, with 10,000 rays a power: twice as
/// much lets about twice as many rays come late, of which low powers have more (3 at
/// power 2 delays 0.2 % of those that hit by more than 1.5 pixels, 4 delays 0.4 %); 6 at
/// power 8 stops 0.07 % of them more than eight pixels late and needs a third of the steps of 2.
pub fn step_factor(fractal: &Fractal) -> f64 {
    (0.75 * fractal.power).clamp(3.0, 6.0)
}

/// The longest step a ray takes inside the bounding sphere of radius `bounding_radius`, in scene
/// units: a twentieth of it for the Julia form, any for the Mandelbulb.
///
/// A Julia orbit that passes the origin on its way out makes dr vanish, so that the estimate
/// grows without bound close to the surface; with the Mandelbulb's + 1 it cannot.
pub fn max_step(fractal: &Fractal, bounding_radius: f64) -> f64 {
    if fractal.julia { 0.05 * bounding_radius } else { f64::INFINITY }
}

/// [`bounding_radius`], which takes thousands of powers, or the same as it was found before.
fn remembered_radius(fractal: &Fractal) -> f64 {
    RADII.with_borrow_mut(|radii| {
        if let Some((_, radius)) = radii.iter().find(|(known, _)| known == fractal) {
            return *radius;
        }
        let radius = bounding_radius(fractal);
        radii.truncate(RADII_KEPT - 1);
        radii.insert(0, (fractal.clone(), radius));
        radius
    })
}

/// The radius of the sphere about the origin outside of which every orbit passes the bailout
/// within the fractal's iterations, with a margin of one percent; in scene units.
///
/// By the triangle inequality |zⁿ + c| ≥ |z|ⁿ − |c|, so the slowest conceivable orbit from
/// radius R is x₀ = R, x ← xⁿ − K with K = R (Mandelbulb) or |c| (Julia form). The least R whose
/// slowest orbit escapes is found by bisection; whatever starts past the bailout has escaped.
pub fn bounding_radius(fractal: &Fractal) -> f64 {
    let constant = fractal.julia.then(|| DVec3::from_array(fractal.julia_constant).length());
    let escapes = |radius: f64| {
        let pull = constant.unwrap_or(radius);
        let mut x = radius;
        for _ in 0..fractal.iterations {
            if x > fractal.bailout {
                return true;
            }
            // Once it shrinks it never recovers.
            let next = x.powf(fractal.power) - pull;
            if next <= x {
                return false;
            }
            x = next;
        }
        x > fractal.bailout
    };
    let (mut inside, mut outside) = (0.0, fractal.bailout);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if escapes(middle) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    outside * (1.0 + BOUNDING_MARGIN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remembered_radii_are_those_of_their_sets() {
        let set = |i: usize| Fractal {
            power: 2.0 + i as f64,
            iterations: 20,
            bailout: 2.0,
            julia: i.is_multiple_of(2),
            ..Default::default()
        };
        // More sets than are remembered, some of them twice in a row.
        for i in (0..3 * RADII_KEPT).map(|i| i / 2 % (RADII_KEPT + 1)) {
            let fractal = set(i);
            assert_eq!(Estimator::new(&fractal).bounding_radius(), bounding_radius(&fractal));
        }
    }
}
