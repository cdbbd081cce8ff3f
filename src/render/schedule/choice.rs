//! Which sample points come next: how sparse an opening is, and by which way it is completed.

use super::{Job, Pace, Points, Schedule, Stage, rate::Aim};
use crate::render::lattice::{COARSEST, Grid, MOST_TOGETHER};

/// A full frame that is done this soon comes straight after the opening, milliseconds.
pub(super) const STRAIGHT_MS: f64 = 1000.0;

/// Any other one comes once this lattice level, one pixel of 32, has been seen.
pub(super) const PREVIEW_LEVEL: u32 = 5;

/// The finest lattice level whose pixels are so few that they are computed once more.
const SPARSE_LEVEL: u32 = 3;

impl Schedule {
    /// What comes after everything computed so far.
    pub(super) fn next_points(&self, now_secs: f64) -> Option<Points> {
        match self.shaded {
            None if self.pace == Pace::Still => Some(Points::Level(0)),
            None => Some(Points::Level(self.opening_level())),
            Some(level) if self.filmed() != Some(level) && self.indirect_now(level, now_secs) => {
                Some(Points::Indirect(self.finest_indirect(level)))
            }
            Some(0) if self.samples_done < self.samples_wanted => {
                let left = self.samples_wanted - self.samples_done;
                Some(Points::Samples { first: self.samples_done, count: left.min(MOST_TOGETHER) })
            }
            Some(0) => None,
            Some(level) => Some(self.completing(level)),
        }
    }

    /// What comes after a lattice of `level` on the way to all pixels.
    fn completing(&self, level: u32) -> Points {
        let is_short = self.whole_ms() <= STRAIGHT_MS;
        // Where it takes long, more of the picture is seen first. Then the film shows how far it
        // is, which it cannot while it waits for indirect light.
        let is_dense_enough = level <= PREVIEW_LEVEL && !self.has_indirect;
        if level >= SPARSE_LEVEL && (is_short || is_dense_enough) {
            Points::All
        } else {
            Points::Added(level - 1)
        }
    }

    /// What all pixels take at one go, milliseconds.
    pub(super) fn whole_ms(&self) -> f64 {
        let pixels = Grid::level(0, self.size_px).threads();
        self.cost.expected_ms(self.job(Points::All), Aim::Refining, pixels)
    }

    /// The finest lattice that the budget allows, and none finer than the G-buffer where only
    /// light is stale.
    fn opening_level(&self) -> u32 {
        let finest = self.gbuffer_validity.marched().unwrap_or(0);
        self.finest_within_budget(finest, |level| self.job(Points::Level(level)), self.has_indirect)
    }

    /// The finest level, none finer than `finest`, that the budget has room for. `has_indirect`: with
    /// its indirect light.
    fn finest_within_budget(
        &self,
        finest: u32,
        job: impl Fn(u32) -> Job,
        has_indirect: bool,
    ) -> u32 {
        // What refined the picture before cannot be called back.
        let refining = self.in_flight.iter().filter(|piece| piece.aim == Aim::Refining);
        let before_ms = refining.map(|piece| piece.expected_ms).sum();
        let fits = |level: &u32| {
            let pixels = Grid::level(*level, self.size_px).threads();
            self.cost.fits(self.budget_ms, before_ms, pixels, job(*level), has_indirect)
        };
        (finest..COARSEST).find(fits).unwrap_or(COARSEST)
    }

    /// Whether a level gets its indirect light, rather than wait for a finer one: where it is the
    /// first to be seen, or the last, or where something new should be seen by now.
    fn indirect_now(&self, level: u32, now_secs: f64) -> bool {
        self.opening || level == 0 || now_secs - self.shown_at >= self.show_interval_secs()
    }

    /// The level whose indirect light comes next, where `shaded` has its direct light: where that
    /// is too fine for the budget, an edit opens on a coarser one.
    fn finest_indirect(&self, shaded: u32) -> u32 {
        if !self.opening || self.pace == Pace::Still {
            return shaded;
        }
        self.finest_within_budget(shaded, |level| self.job(Points::Indirect(level)), false)
    }

    /// Samples so far with what has been submitted of those under way.
    pub(super) fn samples_so_far(&self) -> f32 {
        let pixels_at = |level: u32| 1.0 / (1_u64 << level) as f32;
        let share = self.under_way.map_or(0.0, |(points, next)| {
            next as f32 / points.grid(self.size_px).workgroups().max(1) as f32
        });
        let there = match self.samples_done {
            0 => self.shaded.map_or(0.0, pixels_at),
            done => done as f32,
        };
        match self.under_way {
            Some((Points::Samples { count, .. }, _)) => there + count as f32 * share,
            Some((Points::Level(level) | Points::Added(level), _)) => {
                there + (pixels_at(level) - there).max(0.0) * share
            }
            // These go over the pixels that the lattice has once more.
            Some((Points::All, _)) => there.max(share),
            Some((Points::Indirect(_), _)) | None => there,
        }
    }

    /// What samples need: the stage they have to start with, and the lights they have to be
    /// marched toward.
    pub(super) fn job(&self, points: Points) -> Job {
        let (from, lights) = match points {
            Points::Level(level) | Points::Added(level) => {
                self.gbuffer_validity.start(level, self.shining)
            }
            Points::All => self.gbuffer_validity.start(0, self.shining),
            Points::Indirect(_) => (Stage::Indirect, 0),
            Points::Samples { .. } => (Stage::March, self.shining),
        };
        Job { from, lights }
    }
}
