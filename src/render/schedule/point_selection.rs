//! Which sample points come next: the density of an opening, and the order in which it is completed.
//!
//! In: the picture's progress, the cost of work, the motion budget. Out: [`Points`].

use super::{
    cost::Cost,
    progress::Progress,
    types::{Pace, Phase},
    work::{Job, Points},
};
use crate::render::lattice::{COARSEST, MAX_SAMPLES_TOGETHER};

/// Longest full frame that is computed straight after the opening, milliseconds.
const STRAIGHT_MS: f64 = 1000.0;

/// Longer full frames first refine to this lattice level, one pixel of 32.
pub const PREVIEW_LEVEL: u32 = 5;

/// Finest lattice level after which all pixels are computed at once.
const SPARSE_LEVEL: u32 = 3;

/// All that the next points depend on.
#[derive(Clone, Copy)]
pub struct PointSelection<'a> {
    /// How much of the picture has been computed.
    pub progress: &'a Progress,
    /// What work costs.
    pub cost: &'a Cost,
    /// How the view spends GPU time.
    pub pace: Pace,
    /// GPU time of a moving picture, milliseconds.
    pub budget_ms: f64,
    /// Samples that each pixel gets.
    pub samples_wanted: u32,
    /// Whether no picture of the last change has been shown.
    pub is_opening: bool,
    /// Whether enough time has passed for another display.
    pub is_display_due: bool,
    /// Estimated time of refining work in flight, which can't be cancelled, milliseconds.
    pub in_flight_ms: f64,
}

impl PointSelection<'_> {
    /// The points to compute next; none where all samples are done.
    pub fn next_points(&self) -> Option<Points> {
        let progress = self.progress;
        match progress.shaded {
            None if self.pace == Pace::Still || progress.awaits_light => Some(Points::Level(0)),
            None => Some(Points::Level(self.opening_level())),
            Some(level) if progress.filmed() != Some(level) && self.is_indirect_due(level) => {
                Some(Points::Indirect(self.finest_indirect(level)))
            }
            Some(0) if progress.samples_done < self.samples_wanted => {
                let until = match progress.kept_samples() {
                    kept if kept > progress.samples_done => self.samples_wanted.min(kept),
                    _ => self.samples_wanted,
                };
                let left = until - progress.samples_done;
                let count = left.min(MAX_SAMPLES_TOGETHER);
                Some(Points::Samples { first: progress.samples_done, count })
            }
            Some(0) => None,
            Some(level) => Some(self.completing(level)),
        }
    }

    /// Whether all pixels at once take long enough for a filled preview first.
    pub fn needs_preview(&self) -> bool {
        let pixels = self.computed_pixels(Points::All);
        let job = self.progress.job(Points::All);
        self.cost.expected_ms(job, Phase::Refining, pixels) > STRAIGHT_MS
    }

    /// About how many pixels are computed for `points`.
    fn computed_pixels(&self, points: Points) -> u32 {
        let threads = points.grid(self.progress.size_px).threads();
        self.progress.kept_pixels(points).computed(threads)
    }

    /// The points after a lattice of `level`, on the way to all pixels.
    fn completing(&self, level: u32) -> Points {
        // The film shows pixels under way only where it does not wait for indirect light.
        let is_dense_enough = level <= PREVIEW_LEVEL && !self.progress.has_indirect;
        if level >= SPARSE_LEVEL && (is_dense_enough || !self.needs_preview()) {
            Points::All
        } else {
            Points::Added(level - 1)
        }
    }

    /// The finest lattice that fits the budget.
    ///
    /// Not finer than the G-buffer if only light is stale.
    fn opening_level(&self) -> u32 {
        let progress = self.progress;
        let finest = progress.gbuffer_validity.depth().unwrap_or(0);
        let job = |level| progress.job(Points::Level(level));
        self.finest_within_budget(finest, job, progress.has_indirect)
    }

    /// The finest level, not finer than `finest`, that fits the budget.
    ///
    /// `has_indirect`: the level's indirect light is part of the same picture.
    fn finest_within_budget(
        &self,
        finest: u32,
        job: impl Fn(u32) -> Job,
        has_indirect: bool,
    ) -> u32 {
        let fits = |level: &u32| {
            let pixels = self.computed_pixels(Points::Level(*level));
            self.cost.fits(self.budget_ms, self.in_flight_ms, pixels, job(*level), has_indirect)
        };
        (finest..COARSEST).find(fits).unwrap_or(COARSEST)
    }

    /// Whether a level gets indirect light before a finer level gets direct light.
    ///
    /// True for the first level shown, for the last one, and whenever a display is due.
    fn is_indirect_due(&self, level: u32) -> bool {
        self.is_opening || level == 0 || self.is_display_due
    }

    /// The level that gets indirect light, where `shaded` has direct light. An opening takes a coarser
    /// one where the budget demands it.
    fn finest_indirect(&self, shaded: u32) -> u32 {
        if !self.is_opening || self.pace == Pace::Still {
            return shaded;
        }
        let job = |level| self.progress.job(Points::Indirect(level));
        self.finest_within_budget(shaded, job, false)
    }
}
