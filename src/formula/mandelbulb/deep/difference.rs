//! One step of the difference between two orbits, computed without subtracting orbits.
//!
//! f64 and f32 can follow the difference at any depth.
//!
//! For a reference point Z = (X, Y, Z₃), with ρ, u and w = ρ + iZ₃, and a difference δ = (a, b, c) to Z:
//! `ρ' = |X + a, Y + b|`, `dρ = (2(Xa + Yb) + a² + b²)/(ρ' + ρ)`, `dw = dρ + ic`,
//! `du = (a + ib − u·dρ)/ρ'`; powers by `d(PQ) = dP·Q + (P + dP)·dQ`, and
//! `dz = (d(Re wⁿ·Re uⁿ), d(Re wⁿ·Im uⁿ), d(Im wⁿ))`.

use glam::{DVec2, DVec3};

use super::orbit::ReferencePoint;

/// Differences of a point's ρ and u to those of a reference point.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// dρ.
    pub rho: f64,
    /// du.
    pub rotor: DVec2,
}

impl Deviation {
    /// The deviation of the point at `reference_point` + `delta`.
    pub fn new(reference_point: &ReferencePoint, delta: DVec3) -> Self {
        let (at, aside) = (reference_point.z.truncate(), delta.truncate());
        let rho = (at + aside).length();
        let d_rho = (2.0 * at.dot(aside) + aside.length_squared())
            / (rho + reference_point.rho).max(1e-300);
        let rotor = if rho > 0.0 {
            (aside - reference_point.rotor * d_rho) / rho
        } else {
            // On the axis the rotor is 1.
            DVec2::X - reference_point.rotor
        };
        Self { rho: d_rho, rotor }
    }
}

/// The n-th power of `reference_point` + `delta`, minus the n-th power of `reference_point`.
///
/// `sine_sign` is the sign of the latitude's sine.
pub fn raised(reference_point: &ReferencePoint, delta: DVec3, n: u32, sine_sign: f64) -> DVec3 {
    raised_by(reference_point, Deviation::new(reference_point, delta), delta.z, n, sine_sign)
}

/// [`raised`] for a point on the reference point's own meridian.
pub fn raised_on_meridian(
    reference_point: &ReferencePoint,
    delta: DVec3,
    n: u32,
    sine_sign: f64,
) -> DVec3 {
    let deviation =
        Deviation { rho: reference_point.rotor.dot(delta.truncate()), rotor: DVec2::ZERO };
    raised_by(reference_point, deviation, delta.z, n, sine_sign)
}

fn raised_by(
    reference_point: &ReferencePoint,
    deviation: Deviation,
    up: f64,
    n: u32,
    sine_sign: f64,
) -> DVec3 {
    let w = complex_power(
        DVec2::new(reference_point.rho, reference_point.z.z),
        DVec2::new(deviation.rho, up),
        n,
    );
    let u = complex_power(reference_point.rotor, deviation.rotor, n);
    let across = u.difference * w.value.x + (u.value + u.difference) * w.difference.x;
    DVec3::new(across.x, across.y, sine_sign * w.difference.y)
}

/// A complex number, and the difference of another number to it.
#[derive(Clone, Copy)]
struct Pair {
    value: DVec2,
    difference: DVec2,
}

impl Pair {
    fn times(self, other: Self) -> Self {
        Self {
            value: self.value.rotate(other.value),
            difference: self.difference.rotate(other.value)
                + (self.value + self.difference).rotate(other.difference),
        }
    }
}

/// Powers by squaring, from the exponent's highest bit down.
fn complex_power(value: DVec2, difference: DVec2, n: u32) -> Pair {
    let base = Pair { value, difference };
    (0..n.ilog2()).rev().fold(base, |power, bit| {
        let squared = power.times(power);
        if n >> bit & 1 == 1 { squared.times(base) } else { squared }
    })
}
