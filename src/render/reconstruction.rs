//! Decides how a sparse lattice becomes a whole picture: filled on the film, or upsampled to the display.
//!
//! In: each piece of work before it is recorded. Out: whether its display is upsampled from the
//! lattice's own samples. Upsampling leaves the film unfilled, and saves most of the cost of displaying a
//! moving picture; but passes over the whole film, such as mean and bloom, need a filled film.

use super::schedule::{Display, Points, Work};

/// The state of the film between the pixels of a sparse lattice.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reconstruction {
    /// True if these pixels hold filled colours, false if values of earlier pictures.
    is_filled: bool,
}

impl Reconstruction {
    /// The lattice level from which a display is upsampled; none if the film is filled or nothing is shown.
    ///
    /// `is_plain`: no pass reads the whole film. `finest`: the finest level whose samples fit the buffer.
    pub fn upsample_level(&mut self, work: Work, is_plain: bool, finest: u32) -> Option<u32> {
        let (level, fill, from_film, kept) = match work {
            Work::Display(Display { level, fill, from_film, kept, .. }) => {
                (level, fill, from_film, kept)
            }
            Work::Trace(trace) => {
                self.is_filled &= !matches!(trace.points, Points::Level(_));
                return None;
            }
        };
        if level == 0 {
            return None;
        }
        // The film shows more of kept pixels than the lattice does.
        let is_plain = is_plain && kept.share == 0.0;
        // Filling the film amid a level would overwrite the level's samples: an unfilled film waits for
        // the next complete level.
        if (is_plain && level >= finest && !from_film) || !(fill || self.is_filled) {
            return Some(level.max(finest));
        }
        self.is_filled = true;
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::schedule::{KeptPixels, Stage, Trace};

    fn trace(points: Points) -> Work {
        Work::Trace(Trace {
            points,
            from: Stage::March,
            lights: 0,
            first_block: 0,
            blocks: 1,
            kept: KeptPixels::default(),
            part: None,
        })
    }

    fn display(fill: bool, from_film: bool) -> Work {
        Work::Display(Display {
            level: 4,
            fill,
            from_film,
            adapt: 1.0,
            kept: KeptPixels::default(),
            refines: false,
        })
    }

    #[test]
    fn a_film_that_is_shown_while_pixels_come_is_filled_once_and_not_upsampled() {
        let mut reconstruction = Reconstruction::default();
        let mut upsample_level = |work| reconstruction.upsample_level(work, true, 2);
        assert_eq!(upsample_level(trace(Points::Level(4))), None);
        assert_eq!(upsample_level(display(true, false)), Some(4));
        assert_eq!(upsample_level(display(true, true)), None);
        assert_eq!(upsample_level(trace(Points::All)), None);
        assert_eq!(upsample_level(display(false, true)), None);
        // Values that the last scene left between the pixels of the next scene are not shown.
        assert_eq!(upsample_level(trace(Points::Level(4))), None);
        assert_eq!(upsample_level(display(false, true)), Some(4));
    }
}
