//! The quaternion Julia set in f64, by Hamilton's product and the whole Jacobian: shares no formula with
//! the program.

use glam::{DMat4, DVec3, DVec4};
use mandelight::formula::{Fractal, table::Value};

/// Hamilton's product, real parts first.
pub fn product(p: DVec4, q: DVec4) -> DVec4 {
    DVec4::new(
        p.x * q.x - p.y * q.y - p.z * q.z - p.w * q.w,
        p.x * q.y + p.y * q.x + p.z * q.w - p.w * q.z,
        p.x * q.z - p.y * q.w + p.z * q.x + p.w * q.y,
        p.x * q.w + p.y * q.z - p.z * q.y + p.w * q.x,
    )
}

/// The end of an orbit.
pub struct Orbit {
    /// The last quaternion.
    pub q: DVec4,
    /// How the last quaternion moves with the first.
    pub jacobian: DMat4,
    /// Product of the lengths of all steps' derivatives.
    pub dr: f64,
    /// Steps taken.
    pub steps: u32,
}

/// The orbit of `point` in the fractal's slice.
///
/// # Panics
///
/// If the fractal is of another formula.
pub fn orbit(fractal: &Fractal, point: DVec3) -> Orbit {
    let slice = fractal.number("slice").expect("a quaternion Julia set");
    let Some(Value::Vector(c)) = fractal.get("constant") else { panic!("a constant") };
    let c = DVec4::new(c[0], c[1], c[2], c[3]);
    let mut q = point.extend(slice);
    let (mut jacobian, mut dr, mut steps) = (DMat4::IDENTITY, 1.0, 0);
    while steps < fractal.iterations && q.length() <= fractal.bailout {
        // v to q v + v q, column by column.
        let step = |v: DVec4| product(q, v) + product(v, q);
        let columns = [DVec4::X, DVec4::Y, DVec4::Z, DVec4::W].map(step);
        jacobian = DMat4::from_cols(columns[0], columns[1], columns[2], columns[3]) * jacobian;
        dr *= 2.0 * q.length();
        q = product(q, q) + c;
        steps += 1;
    }
    Orbit { q, jacobian, dr, steps }
}

/// Distance estimate `r ln r / (2 dr)`; zero inside.
pub fn distance(fractal: &Fractal, point: DVec3) -> f64 {
    let Orbit { q, dr, .. } = orbit(fractal, point);
    let r = q.length();
    if r <= 1.0 { 0.0 } else { 0.5 * r.ln() * r / dr }
}
