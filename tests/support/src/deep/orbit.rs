//! Orbits and distance estimates (thesis Algorithm 1): of whole powers at any depth, of others as deep as f64 is.
//!
//! A latitude's and a longitude's multiples are powers of unit complex numbers, so that no
//! trigonometry is needed: with ρ = √(x² + y²) and u = (x + i y)/ρ, `cos nφ + i sin nφ` is
//! `(ρ + i z)ⁿ/rⁿ` and `cos nθ + i sin nθ` is `uⁿ`. On the polar axis the longitude is that of +x. Powers that are not
//! whole are of the angles from −π to π, in f64.

use glam::{DMat3, DVec3};
use mandelight::formula::mandelbulb::{Mandelbulb, Sine};

use super::arithmetic::{Complex, Number, Point, Real, moved, rounded, sum};
use crate::oracle::estimate::escape_radius;

/// Part of the estimate by the derivative's norm that a step covers.
const STEP_PART: f64 = 0.5;

/// On the axis itself the derivative along parallels is infinite; taken for that.
const STRETCH_MAX: f64 = 1e6;

/// Stands in for a distance of zero from the axis, so that its reciprocal is finite.
const MIN_RADIUS: f64 = 1e-90;

/// A Mandelbulb or Julia set, whose orbits are followed with numbers `N`.
pub struct Set<N = Real> {
    power: f64,
    iterations: u32,
    bailout: f64,
    escape_radius: f64,
    is_mirrored: bool,
    julia_constant: Option<Point<N>>,
}

/// What an orbit says of the way to the surface.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// ½ ln r · r / dr; 0 where the orbit does not leave.
    pub distance: f64,
    /// How far a ray may go: by the norm of the orbit's whole derivative, of which the thesis's dr
    /// is no bound. Directions along the parallels are stretched by another factor.
    pub step: f64,
    /// Steps done.
    pub steps: u32,
    /// N − ln(ln r / ln b) / ln n of an orbit that leaves.
    pub smooth_iterations: f64,
    /// Least distances of the orbit, after its start, from the origin and the z axis.
    pub traps: [f64; 2],
}

impl<N: Number> Set<N> {
    /// `fractal`, with orbits of up to `iterations` steps.
    pub fn new(fractal: &Mandelbulb, iterations: u32) -> Self {
        Self {
            power: fractal.power,
            iterations,
            bailout: fractal.bailout,
            escape_radius: escape_radius(fractal),
            is_mirrored: fractal.sine == Sine::Negative,
            julia_constant: fractal.julia.then(|| fractal.julia_constant.map(N::from_f64)),
        }
    }

    /// What the orbit of `point` says. Steps need not care for what is smaller than `grain`.
    pub fn estimate(&self, point: &Point<N>, grain: f64) -> Estimate {
        let End { z, dr, jacobian, steps, traps } = self.follow(point, grain);
        let r = z.length();
        let mut smooth_iterations = f64::from(steps);
        if r > self.bailout {
            let past = (r.ln() / self.bailout.ln()).ln();
            smooth_iterations -= past / self.power.ln();
        }
        let log_radius = if r > self.bailout { r.ln() } else { (r / self.escape_radius).ln() };
        if log_radius <= 0.0 {
            return Estimate { distance: 0.0, step: 0.0, steps, smooth_iterations, traps };
        }
        let height = 0.5 * log_radius * r;
        let distance = height / dr;
        let norm = norm(jacobian.derivative).min(norm(jacobian.unturned));
        let step = (STEP_PART * height / norm).min(distance);
        Estimate { distance, step, steps, smooth_iterations, traps }
    }

    /// Follows the orbit of `point`.
    pub fn follow(&self, point: &Point<N>, grain: f64) -> End {
        let n = self.power;
        let (added, one) = self.julia_constant.as_ref().map_or((point, 1.0), |c| (c, 0.0));
        let mut z = *point;
        let mut end = End {
            z: rounded(&z),
            dr: 1.0,
            jacobian: OrbitJacobian::new(rounded(added), grain),
            steps: 0,
            traps: [f64::INFINITY; 2],
        };
        while end.z.length() <= self.bailout && end.steps < self.iterations {
            end.steps += 1;
            end.dr = n * end.z.length().powf(n - 1.0) * end.dr + one;
            let raised = self.raised(&z);
            end.jacobian.advance(n, one, &raised);
            z = sum(&raised.point, added);
            end.z = rounded(&z);
            let seen = [end.z.length(), end.z.truncate().length()];
            end.traps = [0, 1].map(|i| end.traps[i].min(seen[i]));
        }
        end
    }

    /// zⁿ, and what becomes of small displacements.
    pub fn raised(&self, point: &Point<N>) -> Raised<N> {
        let [x, y, z] = *point;
        let square = x * x + y * y;
        let (rho, u) = if square.is_zero() {
            let zero = N::from_f64(0.0);
            (zero, Complex { re: N::from_f64(1.0), im: zero })
        } else {
            let inverse = square.inverse_sqrt();
            (square * inverse, Complex { re: x * inverse, im: y * inverse })
        };
        let w = Complex { re: rho, im: z };
        let (mut meridian, parallel) = (w.real_power(self.power), u.real_power(self.power));
        let before = Frame::new(w, u);
        if self.is_mirrored {
            meridian.im = -meridian.im;
        }
        let after = Frame::new(meridian, parallel);
        // All lengths grow by n r^(n−1), but parallels by as much as their radius has grown.
        let (n, radius) = (self.power, before.radius);
        let growth = if radius > 0.0 { n * after.radius / radius } else { 0.0 };
        let mirror = if self.is_mirrored { -growth } else { growth };
        let along = n * after.from_axis / before.from_axis.max(f64::MIN_POSITIVE);
        let stretch = DVec3::new(growth, mirror, along.clamp(-STRETCH_MAX, STRETCH_MAX));
        let raising = after.axes * DMat3::from_diagonal(stretch) * before.axes.transpose();
        let point = [meridian.re * parallel.re, meridian.re * parallel.im, meridian.im];
        let longitude = before.axes.z_axis / before.from_axis.max(MIN_RADIUS);
        Raised { point, raising, longitude, parallel: after.axes.z_axis }
    }

    /// The estimate's gradient from central differences, `spacing` apart.
    pub fn gradient(&self, point: &Point<N>, spacing: f64) -> DVec3 {
        let at = |way: DVec3| self.estimate(&moved(point, way), spacing).distance;
        let along = |axis: DVec3| (at(axis * spacing) - at(-axis * spacing)) / (2.0 * spacing);
        DVec3::from_array(DVec3::AXES.map(along))
    }
}

/// Where an orbit ends.
pub struct End {
    pub z: DVec3,
    pub dr: f64,
    pub jacobian: OrbitJacobian,
    pub steps: u32,
    pub traps: [f64; 2],
}

/// What becomes of small displacements of an orbit's point, told in two ways.
pub struct OrbitJacobian {
    pub derivative: DMat3,
    /// The same of the orbit turned back about the axis so far that longitudes stay, and the gradient
    /// of the angle by which it is. Turning is no change of |z|, and the constant turns with it.
    pub unturned: DMat3,
    turn: DVec3,
    /// How the constant moves as it turns.
    around: DVec3,
    grain: f64,
}

impl OrbitJacobian {
    fn new(constant: DVec3, grain: f64) -> Self {
        let around = DVec3::new(-constant.y, constant.x, 0.0);
        let around = if around == DVec3::ZERO { DVec3::Y * MIN_RADIUS } else { around };
        let (derivative, unturned) = (DMat3::IDENTITY, DMat3::IDENTITY);
        Self { derivative, unturned, turn: DVec3::ZERO, around, grain }
    }

    /// One step of power `n`; `one` is the derivative of what it adds.
    fn advance<N>(&mut self, n: f64, one: f64, raised: &Raised<N>) {
        let Raised { raising, longitude, parallel, .. } = raised;
        let identity = DMat3::from_diagonal(DVec3::splat(one));
        self.derivative = *raising * self.derivative + identity;
        self.turn = n * (self.turn + self.unturned.transpose() * *longitude);
        self.unturned = *raising * self.unturned;
        self.unturned -= outer(*parallel, self.unturned.transpose() * *parallel);
        // However far it is turned, the constant does not move farther than across the axis.
        let turn = self.turn.clamp_length_max(2.0 / self.grain);
        self.unturned += identity - outer(self.around, turn);
    }
}

/// A power and its derivatives.
pub struct Raised<N> {
    pub point: Point<N>,
    pub raising: DMat3,
    /// Gradient of the longitude before.
    longitude: DVec3,
    /// Along the parallel, after.
    parallel: DVec3,
}

fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// No less than any length that a unit vector is given, and no more than √3 times the most.
fn norm(matrix: DMat3) -> f64 {
    matrix.to_cols_array().iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// A point's directions outward, along its meridian and along its parallel.
struct Frame {
    axes: DMat3,
    radius: f64,
    /// Distance from the axis, negative where the meridian has passed the pole.
    from_axis: f64,
}

impl Frame {
    /// Of the point at `w` = ρ + i z on the meridian of `u`.
    fn new<N: Number>(w: Complex<N>, u: Complex<N>) -> Self {
        let [from_axis, z, x, y] = [w.re, w.im, u.re, u.im].map(N::to_f64);
        let radius = from_axis.hypot(z);
        let (cosine, sine) =
            if radius > 0.0 { (from_axis / radius, z / radius) } else { (1.0, 0.0) };
        let axes = DMat3::from_cols(
            DVec3::new(cosine * x, cosine * y, sine),
            DVec3::new(-sine * x, -sine * y, cosine),
            DVec3::new(-y, x, 0.0),
        );
        Self { axes, radius, from_axis }
    }
}
