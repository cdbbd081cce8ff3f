//! What the G-buffer holds of the centre samples, and where a trace of them has to start.
//!
//! In: what an edit made stale, and which traces are complete. Out: the first stage that is still
//! missing at a lattice level, and the lights it is missing for. Each part has a level of its own, so
//! that an edit which interrupts another keeps what the first one made stale.

use super::{types::Stale, work::Stage};
use crate::scene::MAX_LIGHTS;

/// The finest lattice level at which every centre sample has something; none where no level has.
type Finest = Option<u32>;

fn covers(finest: Finest, level: u32) -> bool {
    finest.is_some_and(|finest| level >= finest)
}

/// Validity of each part of the centre samples' G-buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GBufferValidity {
    /// Level of depths and colour data.
    depth: Finest,
    /// Level of normals.
    normal: Finest,
    /// Level of each light's visibility bit.
    visibility: [Finest; MAX_LIGHTS],
}

impl Default for GBufferValidity {
    /// Nothing is valid.
    fn default() -> Self {
        Self { depth: None, normal: None, visibility: [None; MAX_LIGHTS] }
    }
}

impl GBufferValidity {
    /// Discards what an edit makes stale, except the bits of moved lights: see
    /// [`Self::invalidate_lights`].
    pub fn invalidate(&mut self, stale: Stale) {
        match stale {
            Stale::Geometry => *self = Self::default(),
            // Shadow rays start along the normal, and their lights depend on the side it faces.
            Stale::Normals => *self = Self { depth: self.depth, ..Self::default() },
            Stale::Light | Stale::Indirect | Stale::Tone => {}
        }
    }

    /// Discards the visibility bits of `lights`.
    pub fn invalidate_lights(&mut self, lights: u64) {
        for (bit, finest) in self.visibility.iter_mut().enumerate() {
            if lights >> bit & 1 == 1 {
                *finest = None;
            }
        }
    }

    /// Discards what only a lattice has: in a picture of another width, its pixels are no lattice.
    pub fn discard_sparse(&mut self) {
        let is_sparse = |finest: &Finest| *finest != Some(0);
        let Self { depth, normal, visibility } = self;
        for finest in [depth, normal].into_iter().chain(visibility) {
            if is_sparse(finest) {
                *finest = None;
            }
        }
    }

    /// The finest level that has depths.
    pub fn depth(&self) -> Option<u32> {
        self.depth
    }

    /// The first stage that a level's centre samples lack.
    ///
    /// Also the lights of `shining` whose bits are missing.
    pub fn first_missing(&self, level: u32, shining: u64) -> (Stage, u64) {
        if !covers(self.depth, level) {
            return (Stage::March, shining);
        }
        if !covers(self.normal, level) {
            return (Stage::Normal, shining);
        }
        let missing = (0..)
            .zip(&self.visibility)
            .filter(|(_, finest)| !covers(**finest, level))
            .fold(0, |bits, (bit, _)| bits | 1_u64 << bit);
        match shining & missing {
            0 => (Stage::Shade, 0),
            lights => (Stage::Shadow, lights),
        }
    }

    /// Marks a level as valid, with the bits of the lights that are `shining`.
    pub fn complete(&mut self, level: u32, shining: u64) {
        let reach = |finest: &mut Finest| *finest = Some(finest.map_or(level, |l| l.min(level)));
        reach(&mut self.depth);
        reach(&mut self.normal);
        for (bit, finest) in self.visibility.iter_mut().enumerate() {
            if shining >> bit & 1 == 1 {
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
        assert_eq!(validity.first_missing(3, 0b111), (Stage::March, 0b111));
        validity.complete(0, 0b111);
        assert_eq!(validity.first_missing(0, 0b111), (Stage::Shade, 0));
        validity.invalidate_lights(0b010);
        assert_eq!(validity.first_missing(0, 0b111), (Stage::Shadow, 0b010));
        assert_eq!(validity.first_missing(0, 0b101), (Stage::Shade, 0));
    }

    #[test]
    fn a_light_that_was_off_keeps_its_bits_until_geometry_changes() {
        let mut validity = GBufferValidity::default();
        validity.complete(0, 0b11);
        assert_eq!(validity.first_missing(0, 0b01), (Stage::Shade, 0));
        assert_eq!(validity.first_missing(0, 0b11), (Stage::Shade, 0));
        validity.invalidate(Stale::Normals);
        assert_eq!(validity.first_missing(0, 0b01), (Stage::Normal, 0b01));
        validity.complete(0, 0b01);
        assert_eq!(validity.first_missing(0, 0b11), (Stage::Shadow, 0b10));
    }

    #[test]
    fn levels_are_kept_apart() {
        let mut validity = GBufferValidity::default();
        validity.complete(4, 1 << 63);
        validity.complete(3, 1 << 63);
        validity.invalidate_lights(1 << 63);
        validity.complete(5, 1 << 63);
        assert_eq!(validity.first_missing(5, 1 << 63), (Stage::Shade, 0));
        assert_eq!(validity.first_missing(4, 1 << 63), (Stage::Shadow, 1 << 63));
        assert_eq!(validity.first_missing(3, 0), (Stage::Shade, 0));
        assert_eq!(validity.first_missing(2, 0), (Stage::March, 0));
    }
}
