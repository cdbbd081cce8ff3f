//! How far it is to the fractal (thesis Algorithm 1, with the line for z.y that its print leaves out).
//!
//! The orbit starts at z₀ = p and steps z ← zⁿ + c, c being the point itself (Mandelbulb) or a
//! constant (Julia form). A scalar stands in for the Jacobian: dr ← n·r^(n−1)·dr + 1, without
//! the + 1 for the Julia form, whose c does not move with the point. The estimate is
//! `½ · ln r · r / dr`. It is zero where the orbit ends with r ≤ 1: inside, or too near to say.

use glam::DVec3;

use super::{march::DistanceField, power::TriplexPower};
use crate::scene::{Fractal, PrecisePoint};

/// How much of the bounding sphere's radius is added to it, to be safe from rounding.
const BOUNDING_MARGIN: f64 = 0.01;
/// Keeps the estimate finite where a Julia orbit passes the origin and dr vanishes.
const LEAST_DERIVATIVE: f64 = 1e-30;

/// One fractal, ready to be measured. Cheap to copy; make a new one when the fractal changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimator {
    power: TriplexPower,
    iterations: u32,
    bailout: f64,
    /// The constant of the Julia form; none for the Mandelbulb, which adds the point itself.
    julia_constant: Option<DVec3>,
    step_scale: f64,
    max_step: f64,
    bounding_radius: f64,
}

impl Estimator {
    /// Prepares `fractal`, which must be within its ranges.
    pub fn new(fractal: &Fractal) -> Self {
        let julia_constant = fractal.julia.then(|| DVec3::from_array(fractal.julia_constant));
        let bounding_radius = bounding_radius(fractal);
        Self {
            power: TriplexPower::new(fractal),
            iterations: fractal.iterations,
            bailout: fractal.bailout,
            julia_constant,
            step_scale: step_scale(fractal),
            max_step: max_step(fractal, bounding_radius),
            bounding_radius,
        }
    }

    /// The estimated distance from `point` to the fractal, in scene units: at least zero, and
    /// zero inside. It is no strict bound: a ray may take [`Self::step_scale`] of it.
    pub fn distance(&self, point: DVec3) -> f64 {
        let (added, dr_added) = match self.julia_constant {
            Some(constant) => (constant, 0.0),
            None => (point, 1.0),
        };
        let (mut z, mut r, mut dr) = (point, point.length(), 1.0);
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            dr = self.power.growth(r) * dr + dr_added;
            z = self.power.apply(z) + added;
            r = z.length();
        }
        if r > 1.0 { 0.5 * r.ln() * r / dr.max(LEAST_DERIVATIVE) } else { 0.0 }
    }

    /// [`Self::distance`] from the f64 nearest to `point`: exact enough down to about 1e-13.
    pub fn distance_at(&self, point: &PrecisePoint) -> f64 {
        self.distance(point.to_dvec3())
    }

    /// The part of the estimate that a ray may step by, 0 to 1; see [`step_scale`].
    pub fn step_scale(&self) -> f64 {
        self.step_scale
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

impl DistanceField for Estimator {
    fn distance(&self, point: DVec3) -> f64 {
        Estimator::distance(self, point)
    }

    fn step_scale(&self) -> f64 {
        self.step_scale
    }

    fn max_step(&self) -> f64 {
        self.max_step
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

/// What part of the estimate a ray steps by: a tenth of the power, from 0.25 to 1; half that
/// for the Julia form.
///
/// The scalar dr is no bound of the Jacobian: near the polar axis the triplex power stretches
/// longitudes by |cos nφ / cos φ| more than dr knows, and low powers pass there more often. A
/// whole estimate steps through the surface where that happens; `tests/fractal.rs` counts how
/// often rays do so against a march with steps sixteen times shorter.
pub fn step_scale(fractal: &Fractal) -> f64 {
    let scale = (fractal.power / 10.0).clamp(0.25, 1.0);
    if fractal.julia { 0.5 * scale } else { scale }
}

/// The longest step a ray takes inside the bounding sphere of radius `bounding_radius`, in scene
/// units: a twentieth of it for the Julia form, any for the Mandelbulb.
///
/// A Julia orbit that passes the origin on its way out makes dr vanish, so that the estimate
/// grows without bound close to the surface; with the Mandelbulb's + 1 it cannot.
pub fn max_step(fractal: &Fractal, bounding_radius: f64) -> f64 {
    if fractal.julia { 0.05 * bounding_radius } else { f64::INFINITY }
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
