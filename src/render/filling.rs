//! How the pixels between those of a sparse lattice come about: on the film, or on the display
//! alone.
//!
//! In: each piece of work before it is recorded. Out: whether its display is spread from the
//! lattice's own samples. That leaves the film unfilled, and saves most of what the display of a
//! moving picture costs; but what has to know the film as a whole, a mean or a bloom, needs it
//! filled.

use super::schedule::{Points, Work};

/// What the film has between the pixels of a sparse lattice.
#[derive(Clone, Copy, Debug, Default)]
pub struct Filling {
    /// Colours, rather than what earlier pictures left.
    is_filled: bool,
}

impl Filling {
    /// The lattice level whose samples a display is spread from; none where the film is filled
    /// for it, or no display is made. `is_plain`: nothing has to know the film as a whole.
    /// `finest`: there is room for the samples of this level and sparser ones.
    pub fn upsample_level(&mut self, work: Work, is_plain: bool, finest: u32) -> Option<u32> {
        let (level, fill, film) = match work {
            Work::Show { level, fill, film, .. } => (level, fill, film),
            Work::Trace(trace) => {
                self.is_filled &= !matches!(trace.points, Points::Level(_));
                return None;
            }
        };
        if level == 0 {
            return None;
        }
        // Where a level is under way the film cannot be filled without losing what is there of
        // it: an unfilled one waits for the next complete level.
        if (is_plain && level >= finest && !film) || !(fill || self.is_filled) {
            return Some(level.max(finest));
        }
        self.is_filled = true;
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::schedule::{Stage, Trace};

    fn trace(points: Points) -> Work {
        Work::Trace(Trace {
            points,
            from: Stage::March,
            lights: 0,
            first_workgroup: 0,
            workgroups: 1,
        })
    }

    fn show(fill: bool, film: bool) -> Work {
        Work::Show { level: 4, fill, film, adapt: 1.0 }
    }

    #[test]
    fn a_film_that_is_shown_while_pixels_come_is_filled_once_and_not_spread() {
        let mut filling = Filling::default();
        let mut upsample_level = |work| filling.upsample_level(work, true, 2);
        assert_eq!(upsample_level(trace(Points::Level(4))), None);
        assert_eq!(upsample_level(show(true, false)), Some(4));
        assert_eq!(upsample_level(show(true, true)), None);
        assert_eq!(upsample_level(trace(Points::All)), None);
        assert_eq!(upsample_level(show(false, true)), None);
        // What the last scene left between the pixels of the next one is not shown.
        assert_eq!(upsample_level(trace(Points::Level(4))), None);
        assert_eq!(upsample_level(show(false, true)), Some(4));
    }
}
