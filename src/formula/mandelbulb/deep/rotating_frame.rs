//! A frame that rotates with an orbit's longitude: even powers need it close to the polar axis.
//!
//! An even power maps the axis to the plane of the equator, and a small circle around the axis to a
//! wide one. So after a step a difference in longitude, however short in length, is of order s/ρ along
//! the parallel. Rounding it costs digits of the differences of order s that matter: all of them as
//! ρ → 0. From then on each step multiplies differences of longitude by n, and differences of radius and
//! height by less. But |z| does not depend on longitudes, and the power rotates as its argument does, n
//! times as far. So an orbit is followed in a frame that rotates after every step until the orbit position
//! has the reference point's longitude. With E the rotor of all rotations so far, y = Ē z (across the axis)
//! steps as
//!
//! `y ← yⁿ + Ēⁿ c,  E ← Eⁿ·e^(iφ),  y ← e^(−iφ)·y`,
//!
//! with φ the longitude of y minus that of the reference point. The reference orbit is not rotated. Before
//! a step the difference to a reference point lies on the reference point's meridian; the step adds
//! `(1 + ē)·o + ē·C` across the axis, where C is the reference's constant, C + o the orbit's, and
//! `e = Eⁿ − 1`, stored as a small number.
//!
//! After some steps E is noise, in f64 as in f32. Its effect is a ripple with a height of about n⁻ᵏ of
//! the whole: no more than rounding.

use glam::{DVec2, DVec3};

use super::{difference::Deviation, orbit::ReferencePoint};

/// The rotation of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotatingFrame {
    /// e: the rotor minus 1.
    ahead: DVec2,
    power: u32,
}

impl RotatingFrame {
    /// The frame without rotation.
    pub fn none(power: u32) -> Self {
        Self { ahead: DVec2::ZERO, power }
    }

    /// Rotates the frame until `reference_point` + `difference` has the reference point's longitude.
    ///
    /// Returns the difference in the new frame, and the rotor of this rotation.
    pub fn settle(
        &mut self,
        reference_point: &ReferencePoint,
        difference: DVec3,
    ) -> (DVec3, DVec2) {
        let deviation = Deviation::new(reference_point, difference);
        let by = Self { ahead: deviation.rotor.rotate(conjugate(reference_point.rotor)), ..*self }
            .normalized();
        *self = Self { ahead: product(self.ahead, by.ahead), ..*self }.normalized();
        ((reference_point.rotor * deviation.rho).extend(difference.z), DVec2::X + by.ahead)
    }

    /// The frame after the power, which multiplies its angle by n.
    pub fn raised(self) -> Self {
        let mut ahead = DVec2::ZERO;
        for bit in (0..u32::BITS - self.power.leading_zeros()).rev() {
            ahead = product(ahead, ahead);
            if self.power >> bit & 1 == 1 {
                ahead = product(ahead, self.ahead);
            }
        }
        Self { ahead, ..self }.normalized()
    }

    /// The rotor by which fixed directions are rotated in the frame.
    pub fn back(self) -> DVec2 {
        DVec2::X + conjugate(self.ahead)
    }

    /// The addend of a step's difference, for a constant `offset` away from the reference's `constant`.
    pub fn added(self, constant: DVec3, offset: DVec3) -> DVec3 {
        let turned = constant.truncate().rotate(conjugate(self.ahead));
        let aside = offset.truncate().rotate(self.back()) + turned;
        aside.extend(offset.z)
    }

    /// Normalises the rotor: rounding changes its length, and each step multiplies the error by n.
    fn normalized(self) -> Self {
        let excess = 2.0 * self.ahead.x + self.ahead.length_squared();
        let length = (1.0 + excess).max(1e-300).sqrt();
        let longer = excess / (1.0 + length);
        Self { ahead: (self.ahead - DVec2::X * longer) / length, ..self }
    }
}

/// The inverse rotation.
fn conjugate(rotor: DVec2) -> DVec2 {
    DVec2::new(rotor.x, -rotor.y)
}

/// (1 + a)(1 + b) − 1.
fn product(a: DVec2, b: DVec2) -> DVec2 {
    a + b + a.rotate(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_turns_keep_their_digits() {
        for power in [2, 7, 8, 16] {
            let first = ReferencePoint::new(DVec3::new(3e-5, -4e-5, 0.9));
            let offset = DVec3::new(4e-18, 3e-18, 1e-17);
            let mut frame = RotatingFrame::none(power);
            let (difference, _) = frame.settle(&first, offset);
            assert!(difference.x.abs() < 1e-21 && difference.y.abs() < 1e-21, "{difference}");
            assert_eq!(difference.z, offset.z);
            let mut angle: f64 = 5e-18 / 5e-5;
            while angle < 0.1 {
                let expected = DVec2::new((0.5 * angle).sin().powi(2) * -2.0, angle.sin());
                let error = (frame.ahead - expected).length();
                assert!(error < 1e-12 * angle, "{power}: {} for {expected}", frame.ahead);
                frame = frame.raised();
                angle *= f64::from(power);
            }
        }
    }

    #[test]
    fn rotors_stay_rotors() {
        let first = ReferencePoint::new(DVec3::new(0.0, 0.0, 0.9));
        let mut frame = RotatingFrame::none(8);
        frame.settle(&first, DVec3::new(3e-20, -1e-20, 0.0));
        for step in 0..200 {
            let length = frame.back().length();
            assert!((length - 1.0).abs() < 1e-13, "{length} at {step}");
            frame = frame.raised();
        }
    }
}
