//! The distance estimate, and the step that a ray may take (thesis Algorithm 1).
//!
//! The thesis prints Algorithm 1 without the line for z.y.
//!
//! The orbit starts at z₀ = p and steps z ← zⁿ + c, where c is the point itself (Mandelbulb) or a
//! constant (Julia form). A scalar replaces the Jacobian: dr ← n·r^(n−1)·dr + 1, without
//! the + 1 for the Julia form, whose c does not depend on the point. The estimate is
//! `½ · ln r · r / dr` for an orbit that passes the bailout. Another orbit takes all iterations, and its estimate is
//! `½ · ln(r/R) · r / dr` with the [escape radius](escape_radius) R, or zero within R, where orbits of the set's points stay:
//! inside, or too near to decide.
//!
//! dr does not bound the Jacobian: two of the power's singular values are n·r^(n−1), but the third,
//! along the parallels, is n·|Re wⁿ|/ρ, larger near the polar axis. Steps of the whole estimate pass
//! through thin walls if an orbit comes near the axis. So a second scalar dg grows by the largest of the
//! three, up to a cap ([`SIDEWAYS_MAX`]), which is far too careful away from the axis: a ray steps by several times the estimate by dg
//! ([`step_factor`]), and at most by the estimate by dr. `tests/cpu/fractal/properties.rs` counts the
//! surfaces that rays still miss, against a march with far shorter steps. Kernels of powers that are not whole carry
//! the image of a ray's direction too, for the seams below; a step is at most ½ · ln r · r over its length, which in some
//! Julia sets is twice dr.
//!
//! Two places of an orbit end a step, since estimates in front of them don't hold behind them:
//!
//! - The seam of a power that is not whole: zⁿ jumps at the half plane y = 0, x < 0, where longitudes change from π
//!   to −π. The kernels follow the ray's direction to the seam; without a direction, steps end at the least distance.
//! - The origin, in the Julia form: dr vanishes there, and the estimate grows without bound beside a surface.
//!
//! At power 2, and sometimes at 3, orbits that pass near the axis early cause false minima, thin as hairs:
//! the estimate falls from several hit distances to below one and back within thousandths of a hit distance.
//! The Jacobian's norm detects these hairs, but an estimate by the norm would draw them as thick as pixels,
//! the polar axis among them, mostly far from the set. So a ray hits only if the distance stays below
//! the hit distance ([`DistanceField::needs_hit_check`]).

use glam::{DMat3, DVec2, DVec3};

use super::{
    parameters::{HIT_CHECK_BELOW, Mandelbulb},
    power::TriplexPower,
};
use crate::formula::{DistanceField, Estimate, OrbitPosition, bounds::slowest_escape};

/// Greatest stretch along the parallels that one step adds to dg, over n·r^(n−1).
///
/// Uncapped, the stretch would stop every ray at the poles; with a lower cap, rays pass walls where all orbits of a view pass
/// the axis (`docs/notes/marching.md`).
pub const SIDEWAYS_MAX: f64 = 100.0;
/// Longest step of a ray of a Julia set, over the way by which an orbit point would get to the origin.
const ORIGIN_PART: f64 = 0.5;
/// Step of a deep ray over the estimate by the Jacobian's norm (Frobenius).
///
/// With one half, a ray reaches the surface from 10³² times as far in about a hundred steps.
const JACOBIAN_STEP_FACTOR: f64 = 0.5;
/// [`SIDEWAYS_MAX`] for the Jacobian that sets the steps of deep rays.
pub const DEEP_SIDEWAYS_MAX: f64 = 300.0;
/// Keeps the estimate finite if a Julia orbit passes the origin and dr vanishes.
const MIN_DERIVATIVE: f64 = 1e-30;

/// The distance estimator of one fractal.
///
/// Cheap to copy; made once per edit, since its bounding radius takes thousands of powers.
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
    log_escape_radius: f64,
    needs_hit_check: bool,
}

impl Estimator {
    /// Prepares `fractal`, which must be within its ranges.
    pub fn new(fractal: &Mandelbulb) -> Self {
        let julia_constant = fractal.julia.then(|| DVec3::from_array(fractal.julia_constant));
        let bounding_radius = bounding_radius(fractal);
        Self {
            power: TriplexPower::new(fractal),
            iterations: fractal.iterations,
            bailout: fractal.bailout,
            julia_constant,
            step_factor: step_factor(fractal),
            max_step: max_step(fractal, bounding_radius),
            bounding_radius,
            log_escape_radius: escape_radius(fractal).ln(),
            needs_hit_check: fractal.power < HIT_CHECK_BELOW,
        }
    }

    /// The estimated distance from `point` to the fractal, in scene units; 0 inside.
    ///
    /// The distance is no strict lower bound: a ray steps by [`Self::estimate`].
    pub fn distance(&self, point: DVec3) -> f64 {
        self.estimate(point).distance
    }

    /// The estimated distance and the safe step of a ray; see the module's head.
    pub fn estimate(&self, point: DVec3) -> Estimate {
        let (added, dr_added) = match self.julia_constant {
            Some(constant) => (constant, 0.0),
            None => (point, 1.0),
        };
        let (mut z, mut r, mut dr, mut dg) = (point, point.length(), 1.0_f64, 1.0_f64);
        let mut limit = f64::INFINITY;
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            limit = limit.min(self.longest_step(z, dr, dg));
            let (raised, growth) = (self.power.apply(z), self.power.growth(r));
            let sideways = self.power.sideways_growth(z, raised);
            dr = growth * dr + dr_added;
            dg = sideways.max(growth).min(SIDEWAYS_MAX * growth) * dg + dr_added;
            z = raised + added;
            r = z.length();
        }
        let Estimate { distance, step } =
            self.estimate_from(r, dr, self.step_factor / dg.max(MIN_DERIVATIVE));
        Estimate { distance, step: step.min(limit) }
    }

    /// Longest step of a ray that keeps the orbit point `z` on its side of the origin and of the seam.
    fn longest_step(&self, z: DVec3, dr: f64, dg: f64) -> f64 {
        let to_origin = if self.julia_constant.is_some() { z.length() } else { f64::INFINITY };
        let has_seam = self.power.exponent().fract() != 0.0;
        // To the half plane y = 0, x < 0.
        let to_seam = match has_seam {
            true if z.x < 0.0 => z.y.abs(),
            true => z.x.hypot(z.y),
            false => f64::INFINITY,
        };
        (ORIGIN_PART * to_origin / dr.max(dg / self.step_factor)).min(to_seam / dg)
    }

    /// [`Self::estimate`] along an orbit that carries its Jacobian, for views about an anchor.
    ///
    /// Over the many steps of a deep orbit dg grows far past the Jacobian's norm, and a ray would creep.
    pub(super) fn estimate_along(&self, mut orbit: impl NormedOrbit) -> Estimate {
        let (mut r, mut dr) = (orbit.z().length(), 1.0);
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            dr = self.power.growth(r) * dr + self.constant_derivative();
            orbit.step(&self.power);
            r = orbit.z().length();
        }
        self.estimate_from(r, dr, JACOBIAN_STEP_FACTOR / orbit.norm().max(MIN_DERIVATIVE))
    }

    /// The first positions of `orbit` until it escapes, at most `length`, with their derivatives.
    pub(super) fn positions(&self, mut orbit: impl Orbit, length: usize) -> Vec<OrbitPosition> {
        let mut positions = Vec::with_capacity(length);
        let constant_derivative = DMat3::from_diagonal(DVec3::splat(self.constant_derivative()));
        let mut jacobian = DMat3::IDENTITY;
        while positions.len() < length {
            let z = orbit.z();
            if z.truncate() == DVec2::ZERO || z.length() > self.bailout {
                break;
            }
            let step = self.power.jacobian(z, f64::INFINITY);
            positions.push(OrbitPosition { z, jacobian, step });
            jacobian = step * jacobian + constant_derivative;
            orbit.step(&self.power);
        }
        positions
    }

    /// Derivative of the added constant by the point: 0 for the Julia form, else 1.
    pub(super) fn constant_derivative(&self) -> f64 {
        if self.julia_constant.is_some() { 0.0 } else { 1.0 }
    }

    /// The estimate at an orbit's end; `careful` is the safe step over `½ · ln r · r`.
    fn estimate_from(&self, r: f64, dr: f64, careful: f64) -> Estimate {
        let log_radius = if r > self.bailout { r.ln() } else { r.ln() - self.log_escape_radius };
        if log_radius <= 0.0 {
            return Estimate { distance: 0.0, step: 0.0 };
        }
        let height = 0.5 * log_radius * r;
        let distance = height / dr.max(MIN_DERIVATIVE);
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

/// An orbit that is followed step by step.
pub(super) trait Orbit {
    /// The current orbit position.
    fn z(&self) -> DVec3;

    /// Steps to the next orbit position.
    fn step(&mut self, power: &TriplexPower);
}

/// An orbit that carries its Jacobian.
pub(super) trait NormedOrbit: Orbit {
    /// The norm of the Jacobian: of the orbit position's derivative by the point.
    fn norm(&self) -> f64;
}

impl DistanceField for Estimator {
    fn distance(&self, point: DVec3) -> f64 {
        Estimator::distance(self, point)
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        Estimator::estimate(self, point)
    }

    /// Whether the orbit stays within the bailout: estimates may be positive there.
    fn is_inside(&self, point: DVec3) -> bool {
        let (mut z, constant) = (point, self.julia_constant.unwrap_or(point));
        for _ in 0..self.iterations {
            if z.length() > self.bailout {
                return false;
            }
            z = self.power.apply(z) + constant;
        }
        z.length() <= self.bailout
    }

    fn needs_hit_check(&self) -> bool {
        self.needs_hit_check
    }

    fn orbit(&self, point: DVec3, length: usize) -> Vec<OrbitPosition> {
        self.positions(
            PlainOrbit { z: point, constant: self.julia_constant.unwrap_or(point) },
            length,
        )
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

/// An orbit in f64 about the scene's origin.
struct PlainOrbit {
    z: DVec3,
    constant: DVec3,
}

impl Orbit for PlainOrbit {
    fn z(&self) -> DVec3 {
        self.z
    }

    fn step(&mut self, power: &TriplexPower) {
        self.z = power.apply(self.z) + self.constant;
    }
}

/// Step of a ray over the estimate by dg.
///
/// Measured with 10,000 rays per power: twice the factor delays about twice as many rays, and low powers
/// delay more (at power 2, a factor of 3 delays 0.2 % of the rays that hit by more than 1.5 pixels, 4 delays
/// 0.4 %). At power 8, a factor of 6 stops 0.07 % of them over 8 pixels late, in a third of the steps of 2.
pub fn step_factor(fractal: &Mandelbulb) -> f64 {
    (0.75 * fractal.power).clamp(3.0, 6.0)
}

/// The longest safe step of a ray inside the bounding sphere, in scene units.
///
/// A twentieth of `bounding_radius` for the Julia form, unlimited for the Mandelbulb. A Julia orbit that
/// passes the origin before it escapes makes dr vanish, so that the estimate grows without bound close to
/// the surface; the Mandelbulb's + 1 prevents this.
pub fn max_step(fractal: &Mandelbulb, bounding_radius: f64) -> f64 {
    if fractal.julia { 0.05 * bounding_radius } else { f64::INFINITY }
}

/// The radius R from which orbits of the set's points would grow for ever, in scene units; they never leave it.
///
/// By the triangle inequality an orbit point farther out grows: Rⁿ − |c| = R, where |c| is at most R for the Mandelbulb.
pub fn escape_radius(fractal: &Mandelbulb) -> f64 {
    let Mandelbulb { power, julia_constant, .. } = *fractal;
    if !fractal.julia {
        return 2.0_f64.powf(1.0 / (power - 1.0));
    }
    let constant = DVec3::from_array(julia_constant).length();
    // R = (R + |c|)^(1/n), which converges from anywhere above 1.
    (0..64).fold(1.0 + constant, |radius, _| (radius + constant).powf(1.0 / power))
}

/// Radius about the origin beyond which every orbit escapes, in scene units.
pub fn bounding_radius(mandelbulb: &Mandelbulb) -> f64 {
    let Mandelbulb { power, iterations, bailout, .. } = *mandelbulb;
    let constant = mandelbulb.julia.then(|| DVec3::from_array(mandelbulb.julia_constant).length());
    slowest_escape(power, constant, iterations, bailout)
}
