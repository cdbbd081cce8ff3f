//! What the G-buffer holds of the centre samples, and where a trace of them has to start.
//!
//! In: what an edit made untrue, and which traces are complete. Out: the first stage that is still
//! to be done at a lattice level, and for which lights. Each part keeps a level of its own, so
//! that an edit which interrupts another forgets nothing that the first one asked for.

use super::{Stage, Stale};
use crate::scene::MAX_LIGHTS;

/// The finest lattice level at which something is true of every centre sample; none where at no
/// level.
type Finest = Option<u32>;

fn holds(finest: Finest, level: u32) -> bool {
    finest.is_some_and(|finest| level >= finest)
}

/// What is true of the centre samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GBufferValidity {
    /// They have depth and colour data.
    marched: Finest,
    /// They have normals.
    faced: Finest,
    /// They have the bit of each light.
    lit: [Finest; MAX_LIGHTS],
}

impl Default for GBufferValidity {
    /// Nothing.
    fn default() -> Self {
        Self { marched: None, faced: None, lit: [None; MAX_LIGHTS] }
    }
}

impl GBufferValidity {
    /// Forgets what an edit made untrue; which lights it moved is for [`Self::forget_lights`].
    pub fn forget(&mut self, stale: Stale) {
        match stale {
            Stale::Geometry => *self = Self::default(),
            // Where a point faces, and where its shadow rays start, depends on the normal.
            Stale::Normals => *self = Self { marched: self.marched, ..Self::default() },
            Stale::Light | Stale::Indirect | Stale::Tone => {}
        }
    }

    /// Forgets the bits of `lights`.
    pub fn forget_lights(&mut self, lights: u64) {
        for (bit, finest) in self.lit.iter_mut().enumerate() {
            if lights >> bit & 1 == 1 {
                *finest = None;
            }
        }
    }

    /// The finest level that has depths.
    pub fn marched(&self) -> Option<u32> {
        self.marched
    }

    /// Where the centre samples of a level have to start, and the lights that they have to be
    /// marched toward, of those that are `wanted`.
    pub fn start(&self, level: u32, wanted: u64) -> (Stage, u64) {
        if !holds(self.marched, level) {
            return (Stage::March, wanted);
        }
        if !holds(self.faced, level) {
            return (Stage::Normal, wanted);
        }
        let unknown = (0..)
            .zip(&self.lit)
            .filter(|(_, finest)| !holds(**finest, level))
            .fold(0, |bits, (bit, _)| bits | 1_u64 << bit);
        match wanted & unknown {
            0 => (Stage::Shade, 0),
            lights => (Stage::Shadow, lights),
        }
    }

    /// A level has all that it needs, for the lights that are `wanted`.
    pub fn complete(&mut self, level: u32, wanted: u64) {
        let reach = |finest: &mut Finest| *finest = Some(finest.map_or(level, |l| l.min(level)));
        reach(&mut self.marched);
        reach(&mut self.faced);
        for (bit, finest) in self.lit.iter_mut().enumerate() {
            if wanted >> bit & 1 == 1 {
                reach(finest);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_moved_light_is_marched_alone() {
        let mut validity = GBufferValidity::default();
        assert_eq!(validity.start(3, 0b111), (Stage::March, 0b111));
        validity.complete(0, 0b111);
        assert_eq!(validity.start(0, 0b111), (Stage::Shade, 0));
        validity.forget_lights(0b010);
        assert_eq!(validity.start(0, 0b111), (Stage::Shadow, 0b010));
        assert_eq!(validity.start(0, 0b101), (Stage::Shade, 0));
    }

    #[test]
    fn a_light_that_was_out_for_a_while_keeps_its_bits_unless_something_moved() {
        let mut validity = GBufferValidity::default();
        validity.complete(0, 0b11);
        assert_eq!(validity.start(0, 0b01), (Stage::Shade, 0));
        assert_eq!(validity.start(0, 0b11), (Stage::Shade, 0));
        validity.forget(Stale::Normals);
        assert_eq!(validity.start(0, 0b01), (Stage::Normal, 0b01));
        validity.complete(0, 0b01);
        assert_eq!(validity.start(0, 0b11), (Stage::Shadow, 0b10));
    }

    #[test]
    fn levels_are_kept_apart() {
        let mut validity = GBufferValidity::default();
        validity.complete(4, 1 << 63);
        validity.complete(3, 1 << 63);
        validity.forget_lights(1 << 63);
        validity.complete(5, 1 << 63);
        assert_eq!(validity.start(5, 1 << 63), (Stage::Shade, 0));
        assert_eq!(validity.start(4, 1 << 63), (Stage::Shadow, 1 << 63));
        assert_eq!(validity.start(3, 0), (Stage::Shade, 0));
        assert_eq!(validity.start(2, 0), (Stage::March, 0));
    }
}
