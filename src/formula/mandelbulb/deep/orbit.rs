//! Reference orbits: the orbit of one point, computed with many digits.
//!
//! Other orbits are followed by their difference to it, in f64 or f32. The stored points are rounded to
//! f64: this loses a part in 10¹⁶ of each step's factor, not of the orbit's position.

use dashu_float::{FBig, round::mode};
use glam::{DVec2, DVec3};

use crate::{
    formula::{mandelbulb::parameters::Mandelbulb, recurrence::Recurrence},
    precise::PrecisePoint,
};

/// Bits of a coordinate. An error grows along an orbit as distances do: to 10²⁷ times 2⁻²⁵⁶.
const BITS: usize = 256;

/// A binary number of [`BITS`] bits.
type Big = FBig<mode::Zero, 2>;

/// One point of a reference orbit, rounded to f64, with ρ and the rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferencePoint {
    /// z.
    pub z: DVec3,
    /// ρ = |x + iy|.
    pub rho: f64,
    /// u = (x + iy)/ρ; 1 on the axis.
    pub rotor: DVec2,
}

impl ReferencePoint {
    /// The reference point at `z`.
    pub(super) fn new(z: DVec3) -> Self {
        let rho = z.x.hypot(z.y);
        let rotor = if rho > 0.0 { z.truncate() / rho } else { DVec2::X };
        Self { z, rho, rotor }
    }
}

/// An orbit under construction.
///
/// Each step computes about 20 products of 256 bits in some microseconds, so that a caller can pause
/// between steps.
#[derive(Clone, Debug)]
pub struct Tracer {
    z: [Big; 3],
    constant: [Big; 3],
    power: u32,
    sine_sign: Big,
    limit: f64,
    most: usize,
    reference_points: Vec<ReferencePoint>,
    has_ended: bool,
}

impl Tracer {
    /// The orbit of `point`; none if the power is not a whole number.
    ///
    /// The orbit has at most `most` points and ends with the first point past the bailout.
    pub fn of_point(fractal: &Mandelbulb, point: &PrecisePoint, most: usize) -> Option<Self> {
        let start = big_point(point);
        let constant = if fractal.julia { julia_constant(fractal) } else { start.clone() };
        Self::new(fractal, start, constant, most)
    }

    /// The Julia form's orbit of the origin, from its first step on: starts at the constant.
    pub fn critical(fractal: &Mandelbulb, most: usize) -> Option<Self> {
        let constant = julia_constant(fractal);
        Self::new(fractal, constant.clone(), constant, most)
    }

    fn new(fractal: &Mandelbulb, z: [Big; 3], constant: [Big; 3], most: usize) -> Option<Self> {
        let sine_sign = big(fractal.sine.sign());
        let power = fractal.integer_power()?;
        let first = ReferencePoint::new(rounded(&z));
        let limit = fractal.bailout;
        let has_ended = most <= 1 || first.z.length() > limit;
        Some(Self {
            z,
            constant,
            power,
            sine_sign,
            limit,
            most,
            reference_points: vec![first],
            has_ended,
        })
    }

    /// Computes the next point; returns false once the orbit has ended.
    pub fn step(&mut self) -> bool {
        if !self.has_ended {
            let raised = raised(&self.z, self.power);
            let [x, y, z] = raised;
            let [cx, cy, cz] = &self.constant;
            self.z = [x + cx, y + cy, z * &self.sine_sign + cz];
            let reference_point = ReferencePoint::new(rounded(&self.z));
            self.reference_points.push(reference_point);
            self.has_ended =
                self.reference_points.len() >= self.most || reference_point.z.length() > self.limit;
        }
        !self.has_ended
    }

    /// Computes the remaining points and returns all of them.
    pub fn finish(mut self) -> Vec<ReferencePoint> {
        while self.step() {}
        self.reference_points
    }
}

/// The error of `recurrence` at the orbit of `point`.
///
/// None if the power is not a whole number, and where the orbit escapes first.
pub fn recurrence_error(
    fractal: &Mandelbulb,
    point: &PrecisePoint,
    recurrence: Recurrence,
) -> Option<DVec3> {
    let last = recurrence.last();
    let mut tracer = Tracer::of_point(fractal, point, last + 1)?;
    let mut first = [Big::ZERO, Big::ZERO, Big::ZERO];
    for index in 0..last {
        if recurrence.first() == Some(index) {
            first = tracer.z.clone();
        }
        let is_last = index + 1 == last;
        if !tracer.step() && !is_last {
            return None;
        }
    }
    let [x, y, z] = &tracer.z;
    Some(rounded(&[x - &first[0], y - &first[1], z - &first[2]]))
}

fn big(value: f64) -> Big {
    // Only infinities and NaN have no binary form; a scene's constants are finite.
    Big::try_from(value).unwrap_or(Big::ZERO).with_precision(BITS).value()
}

fn big_point(point: &PrecisePoint) -> [Big; 3] {
    point.0.each_ref().map(|coordinate| coordinate.to_binary(BITS))
}

fn julia_constant(fractal: &Mandelbulb) -> [Big; 3] {
    fractal.julia_constant.map(big)
}

fn rounded(z: &[Big; 3]) -> DVec3 {
    DVec3::from_array(z.each_ref().map(|coordinate| coordinate.to_f64().value()))
}

/// zⁿ: see [`crate::formula::mandelbulb::power`].
///
/// The rotor is a plain division by ρ, however small: the exponents of these numbers hold ρ².
fn raised([x, y, z]: &[Big; 3], n: u32) -> [Big; 3] {
    let a = x * x + y * y;
    let rho = a.sqrt();
    let [across, up] = complex_power([rho.clone(), z.clone()], n);
    if rho == Big::ZERO {
        return [across, Big::ZERO, up];
    }
    let [cosine, sine] = complex_power([x / &rho, y / &rho], n);
    [&across * cosine, &across * sine, up]
}

/// Powers by squaring, from the exponent's highest bit down.
fn complex_power(base: [Big; 2], n: u32) -> [Big; 2] {
    let [re, im] = &base;
    let (mut x, mut y) = (re.clone(), im.clone());
    for bit in (0..n.ilog2()).rev() {
        let both = &x * &y;
        (x, y) = ((&x - &y) * (&x + &y), &both + &both);
        if n >> bit & 1 == 1 {
            (x, y) = (&x * re - &y * im, &x * im + &y * re);
        }
    }
    [x, y]
}
