//! Orbits in a frame that turns with their point's longitude: what even powers need hard by the
//! polar axis.
//!
//! An even power takes the axis to the plane of the equator, and a small circle around the axis to a
//! wide one. So a difference in longitude, however small in length, is one of order s/ρ after a
//! step, along the parallel, and rounding it takes digits from what matters, which is of order s:
//! with ρ → 0 all of them. But |z| does not care for longitudes, and the power turns as its
//! argument does, n times as far. So an orbit is followed as it looks from a frame that has been
//! turned by D₁, the point's longitude less the anchor's, and n times as far after each step:
//! `yₖ = R(−nᵏ⁻¹D₁) zₖ` begins at the anchor's longitude, and
//!
//! `yₖ₊₁ = yₖⁿ + R(−nᵏD₁) c`,
//!
//! with the reference as it is. Its difference steps as any other does; only what is added turns:
//! with `e = e^(inᵏD₁) − 1`, kept as a small number, and a constant that is `o` away from the
//! reference's C, that is `(1 + ē)·o + ē·C` across the axis.
//!
//! After some steps nᵏD₁ is noise, in f64 as in f32. What is added then is a ripple of a height of
//! about n⁻ᵏ of the whole: as much as rounding.

use glam::{DVec2, DVec3};

use super::{difference::Aside, orbit::Place};

/// How far a frame has been turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// e: what the rotor is more than 1.
    ahead: DVec2,
    power: u32,
}

impl Turn {
    /// The frame in which the point that is `offset` away from an orbit's first place has that
    /// place's longitude, and its difference to the place there, for the power `n`.
    pub fn of(first: &Place, offset: DVec3, n: u32) -> (Self, DVec3) {
        let aside = Aside::new(first, offset);
        let conjugate = DVec2::new(first.rotor.x, -first.rotor.y);
        let turn = Self { ahead: aside.rotor.rotate(conjugate), power: n };
        (turn.normalized(), (first.rotor * aside.rho).extend(offset.z))
    }

    /// The frame a step later.
    pub fn next(self) -> Self {
        let mut ahead = DVec2::ZERO;
        for bit in (0..u32::BITS - self.power.leading_zeros()).rev() {
            ahead = product(ahead, ahead);
            if self.power >> bit & 1 == 1 {
                ahead = product(ahead, self.ahead);
            }
        }
        Self { ahead, ..self }.normalized()
    }

    /// How a fixed direction turns in it.
    pub fn rotor(self) -> DVec2 {
        DVec2::X + self.back()
    }

    /// What a constant adds to the difference that is `offset` away from the reference's.
    pub fn added(self, constant: DVec3, offset: DVec3) -> DVec3 {
        let aside =
            offset.truncate().rotate(self.rotor()) + constant.truncate().rotate(self.back());
        aside.extend(offset.z)
    }

    fn back(self) -> DVec2 {
        DVec2::new(self.ahead.x, -self.ahead.y)
    }

    /// Rounding makes the rotor longer or shorter, and each step n times as much.
    fn normalized(self) -> Self {
        let excess = 2.0 * self.ahead.x + self.ahead.length_squared();
        let length = (1.0 + excess).max(1e-300).sqrt();
        let longer = excess / (1.0 + length);
        Self { ahead: (self.ahead - DVec2::X * longer) / length, ..self }
    }
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
            let first = Place::new(DVec3::new(3e-5, -4e-5, 0.9));
            let offset = DVec3::new(4e-18, 3e-18, 1e-17);
            let (mut turn, difference) = Turn::of(&first, offset, power);
            assert!(difference.x.abs() < 1e-21 && difference.y.abs() < 1e-21, "{difference}");
            assert_eq!(difference.z, offset.z);
            let mut angle: f64 = 5e-18 / 5e-5;
            while angle < 0.1 {
                let expected = DVec2::new((0.5 * angle).sin().powi(2) * -2.0, angle.sin());
                let error = (turn.ahead - expected).length();
                assert!(error < 1e-12 * angle, "{power}: {} for {expected}", turn.ahead);
                turn = turn.next();
                angle *= f64::from(power);
            }
        }
    }

    #[test]
    fn rotors_stay_rotors() {
        let first = Place::new(DVec3::new(0.0, 0.0, 0.9));
        let (mut turn, _) = Turn::of(&first, DVec3::new(3e-20, -1e-20, 0.0), 8);
        for step in 0..200 {
            let length = turn.rotor().length();
            assert!((length - 1.0).abs() < 1e-13, "{length} at {step}");
            turn = turn.next();
        }
    }
}
