//! The next run of blocks of the points under way.
//!
//! In: the points, what rays cost. Out: a [`Trace`], or one part of it.

use super::{
    Schedule,
    piece_size::{self, PieceSize},
    types::{Pace, Phase},
    work::{BATCH_WORKGROUPS, Job, MAX_PIECE_BLOCKS, Points, Stage, Trace},
};
use crate::render::lattice::{BLOCK_THREADS, COARSEST};

/// Lights are divided where the smallest piece takes over so many times what a piece should take.
const MIN_EXCESS: f64 = 1.5;

impl Schedule {
    /// The next piece of `points`, whose next block is `first_block`.
    pub(super) fn next_trace(&mut self, points: Points, first_block: u32) -> Trace {
        let part = self.progress.take_part().unwrap_or_else(|| {
            let (whole, divisor) = self.next_blocks(points, first_block);
            match self.parts(&whole, divisor) {
                Some(count) => self.progress.divide(whole, count, self.cost.casting()),
                None => whole,
            }
        });
        if !part.shades() {
            return part;
        }
        let next = first_block + part.blocks;
        if next < points.grid(self.progress.size_px).blocks() {
            let is_filmed = self.progress.advance(points, next);
            self.is_display_stale |= is_filmed && self.pace == Pace::Interactive;
        } else {
            self.is_display_stale = self.progress.complete(points);
        }
        part
    }

    /// All that the next piece of `points` computes, and the divisor of its [`PieceSize`].
    fn next_blocks(&mut self, points: Points, first_block: u32) -> (Trace, u32) {
        let job = self.progress.job(points);
        let kept = self.progress.kept_pixels(points);
        let left = points.grid(self.progress.size_px).blocks() - first_block;
        let size = match self.phase() {
            // A GPU computes any lattice that was expected to fit the budget at once.
            Phase::Jump if points.level() == COARSEST || self.piece_sizes.occupancy.is_cpu() => {
                let aim_ms = self.budget_ms.min(piece_size::PIECE_MS);
                self.piece_sizes.of_jump(aim_ms, &self.cost, job, first_block, left)
            }
            // With its display an opening makes the two pieces in flight, so that every displayed
            // frame can have one.
            Phase::Opening | Phase::Jump => PieceSize { blocks: MAX_PIECE_BLOCKS, divisor: 1 },
            Phase::Refining => {
                let aim_ms = piece_size::aim_ms(self.pace, self.budget_ms);
                let are_merged = self.in_flight.are_merged();
                self.piece_sizes.next(aim_ms, &self.cost, job, kept, are_merged)
            }
        };
        let blocks = size.blocks.min(left);
        let Job { from, lights } = job;
        let whole = Trace { points, from, lights, first_block, blocks, kept, part: None };
        (whole, size.divisor)
    }

    /// The parts to submit `whole` in, one of them where more don't pay; none where its lights need not be divided.
    /// `divisor`: that of its [`PieceSize`].
    ///
    /// Lights are divided while someone watches a picture refine, and only where even the smallest piece takes too long. The
    /// buffers hold one batch from part to part. Merged completions don't say what a part takes.
    fn parts(&mut self, whole: &Trace, divisor: u32) -> Option<u32> {
        let is_seen = self.pace == Pace::Interactive && self.phase() == Phase::Refining;
        let is_measured = self.in_flight.has_reliable_times();
        let has_shadows = (Stage::March..=Stage::Shadow).contains(&whole.from);
        if !is_seen || !is_measured || !has_shadows || whole.workgroups() > BATCH_WORKGROUPS {
            return None;
        }
        let aim_ms = piece_size::aim_ms(self.pace, self.budget_ms);
        let fewest =
            self.piece_sizes.fewest_blocks(aim_ms, &self.cost, whole.job()) * BLOCK_THREADS;
        // A piece of half the size has as many parts as others: the cost of a part and of half a piece are told apart.
        let [fewest_ms, largest_ms] = [fewest, divisor * whole.samples()]
            .map(|samples| self.cost.expected_ms(whole.job(), Phase::Refining, samples));
        let most = (whole.lights & self.cost.casting()).count_ones();
        (most > 1 && fewest_ms > MIN_EXCESS * aim_ms)
            .then(|| self.cost.division.next(most, largest_ms, aim_ms))
    }
}
