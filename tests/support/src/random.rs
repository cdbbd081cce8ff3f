//! Numbers that come out the same each time.

use glam::{DVec2, DVec3};

/// A small generator of repeatable numbers (xorshift).
pub struct Random(pub u64);

impl Random {
    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// In −1..1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// A place of a picture, −1..1 each way.
    pub fn ndc(&mut self) -> DVec2 {
        DVec2::new(self.signed(), self.signed())
    }

    /// Evenly within the cube of side 2 about the origin.
    pub fn in_cube(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    /// Evenly within the ball of `radius`, and never quite its centre.
    pub fn in_ball(&mut self, radius: f64) -> DVec3 {
        loop {
            let v = DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if (1e-3..=1.0).contains(&v.length()) {
                return v * radius;
            }
        }
    }
}
