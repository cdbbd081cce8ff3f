//! A frame that rotates with the longitude of an orbit: even powers need it close to the polar axis.
//!
//! An even power takes the axis to the plane of the equator, and a small circle around the axis to a
//! wide one. So a difference in longitude, however small in length, is one of order s/ρ after a
//! step, along the parallel, and rounding it takes digits from what matters, which is of order s:
//! with ρ → 0 all of them. From then on longitudes differ n times as much with every step, where
//! radii and heights grow by less. But |z| does not care for longitudes, and the power turns as its
//! argument does, n times as far. So an orbit is followed as it looks from a frame that is turned,
//! after every step, until the place has the longitude of the reference's. With E the rotor that it
//! has been turned by altogether, y = Ē z (across the axis) steps as
//!
//! `y ← yⁿ + Ēⁿ c,  E ← Eⁿ·e^(iφ),  y ← e^(−iφ)·y`,
//!
//! φ being how far y is ahead of the reference's longitude by then. Its difference to the reference,
//! which is as it is, lies on that one's meridian before a step; what is added to it is
//! `(1 + ē)·o + ē·C` across the axis, for a constant that is `o` away from the reference's C and with
//! `e = Eⁿ − 1`, kept as a small number.
//!
//! After some steps E is noise, in f64 as in f32. What is added then is a ripple of a height of about
//! n⁻ᵏ of the whole: as much as rounding.

use glam::{DVec2, DVec3};

use super::{difference::Deviation, orbit::ReferencePoint};

/// How far a frame has been turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotatingFrame {
    /// e: what the rotor is more than 1.
    ahead: DVec2,
    power: u32,
}

impl RotatingFrame {
    /// None.
    pub fn none(power: u32) -> Self {
        Self { ahead: DVec2::ZERO, power }
    }

    /// Turns on until what is `difference` away from `reference_point` has the place's longitude. Returns the
    /// difference as it is then, and the rotor of that turn.
    pub fn settle(
        &mut self,
        reference_point: &ReferencePoint,
        difference: DVec3,
    ) -> (DVec3, DVec2) {
        let aside = Deviation::new(reference_point, difference);
        let by = Self { ahead: aside.rotor.rotate(conjugate(reference_point.rotor)), ..*self }
            .normalized();
        *self = Self { ahead: product(self.ahead, by.ahead), ..*self }.normalized();
        ((reference_point.rotor * aside.rho).extend(difference.z), DVec2::X + by.ahead)
    }

    /// The frame that turns as the power does.
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

    /// How a fixed direction is turned in it.
    pub fn back(self) -> DVec2 {
        DVec2::X + conjugate(self.ahead)
    }

    /// What a constant adds to the difference that is `offset` away from the reference's.
    pub fn added(self, constant: DVec3, offset: DVec3) -> DVec3 {
        let turned = constant.truncate().rotate(conjugate(self.ahead));
        let aside = offset.truncate().rotate(self.back()) + turned;
        aside.extend(offset.z)
    }

    /// Rounding makes the rotor longer or shorter, and each step n times as much.
    fn normalized(self) -> Self {
        let excess = 2.0 * self.ahead.x + self.ahead.length_squared();
        let length = (1.0 + excess).max(1e-300).sqrt();
        let longer = excess / (1.0 + length);
        Self { ahead: (self.ahead - DVec2::X * longer) / length, ..self }
    }
}

/// How far the other way.
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
