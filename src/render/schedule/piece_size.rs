//! How much a refining piece computes.
//!
//! In: pace, motion budget and what rays cost. Out: the blocks of the next piece.

use super::{
    cost::Cost,
    types::Pace,
    work::{Job, KeptPixels, MAX_PIECE_BLOCKS},
};
use crate::render::occupancy::Occupancy;

/// Longest GPU time that a piece aims at while someone is watching, milliseconds. The last workgroups
/// of each dispatch leave much of the GPU idle: short pieces waste time.
pub const PIECE_MS: f64 = 25.0;

/// Largest part of the motion budget that a refining piece aims at: two of them in flight and a
/// sparse picture together take little more than a budget.
const PIECE_SHARE: f64 = 0.5;

/// GPU time that one piece of a still aims at, milliseconds.
const STILL_PIECE_MS: f64 = 60.0;

/// GPU time that a piece aims at, milliseconds; `budget_ms` is the motion budget.
pub fn aim_ms(pace: Pace, budget_ms: f64) -> f64 {
    match pace {
        Pace::Still => STILL_PIECE_MS,
        Pace::Interactive => PIECE_MS.min(PIECE_SHARE * budget_ms),
    }
}

/// Units of a small piece: it can be halved.
///
/// Pieces of one size can't separate the fixed cost from the cost of rays.
const MIN_UNITS: u32 = 2;

/// Two units are still too large if their rays alone take so many times what a piece should take: two motion budgets.
const MAX_EXCESS: f64 = 2.0 / PIECE_SHARE;

/// Smaller pieces pay only if the fixed cost is less than so large a part of the time of those rays.
const MAX_FIXED_SHARE: f64 = 0.5;

/// Sizes of successive refining pieces.
#[derive(Clone, Debug, Default)]
pub struct PieceSizes {
    /// What pieces are multiples of, and the least one.
    pub occupancy: Occupancy,
    /// Number of pieces so far, modulo 2³².
    issued: u32,
}

/// The size of a piece.
#[derive(Clone, Copy, Debug)]
pub struct PieceSize {
    /// How many blocks, at most [`MAX_PIECE_BLOCKS`].
    pub blocks: u32,
    /// What the blocks of larger pieces are divided by: 2 for a piece of half the size, else 1.
    pub divisor: u32,
}

impl PieceSizes {
    /// Blocks of the smallest piece, before every second one is halved: two units, or what fills the lanes of all cores twice
    /// where two units take too long.
    pub fn fewest_blocks(&self, aim_ms: f64, cost: &Cost, job: Job) -> u32 {
        let of_units = MIN_UNITS * self.occupancy.unit_blocks();
        let (fixed_ms, rays_ms) = cost.piece_ms(of_units, job);
        if rays_ms > MAX_EXCESS * aim_ms && fixed_ms < MAX_FIXED_SHARE * rays_ms {
            MIN_UNITS * self.occupancy.least_blocks()
        } else {
            of_units
        }
    }

    /// The size of the next piece of the first lattice of another view, of which `begun` blocks are submitted and `left`
    /// are not: the first piece is small, and pieces double until one holds all that is left, or takes a piece's time.
    ///
    /// The whole lattice may be thousands of rays, whose cost is not known before the first ones end.
    pub fn of_jump(&self, aim_ms: f64, cost: &Cost, job: Job, begun: u32, left: u32) -> PieceSize {
        let unit = self.occupancy.unit_blocks();
        let whole_units = |blocks: u32| (blocks - blocks % unit).max(unit);
        let blocks = cost.first_blocks(job).max(1).next_multiple_of(unit).max(begun);
        let blocks = blocks.min(whole_units(cost.piece_blocks(aim_ms, job)));
        let is_last = left < 2 * blocks;
        let blocks = if is_last { left } else { blocks };
        PieceSize { blocks: blocks.min(MAX_PIECE_BLOCKS), divisor: 1 }
    }

    /// The size of the next piece: every second piece is half as large as the others, every third one if completions have
    /// arrived together (`are_merged`).
    ///
    /// `kept`: pixels that take no time.
    pub fn next(
        &mut self,
        aim_ms: f64,
        cost: &Cost,
        job: Job,
        kept: KeptPixels,
        are_merged: bool,
    ) -> PieceSize {
        let unit = self.occupancy.unit_blocks();
        let units = cost.piece_blocks(aim_ms, job) / unit;
        let blocks =
            if units < MIN_UNITS { self.fewest_blocks(aim_ms, cost, job) } else { units * unit };
        let computed = f64::from(1.0 - kept.share).max(1e-3);
        let wanted = ((f64::from(blocks) / computed) as u32).min(MAX_PIECE_BLOCKS);
        let largest = if wanted < unit { wanted } else { wanted - wanted % unit };
        // Pieces of two sizes separate the fixed cost of a piece from that of its pixels. Merged
        // completions are of two pieces, so that only every third piece makes pairs of two sizes.
        self.issued = self.issued.wrapping_add(1);
        let divisor =
            if self.issued.is_multiple_of(if are_merged { 3 } else { 2 }) { 2 } else { 1 };
        let blocks = largest.div_ceil(divisor);
        let blocks = if blocks < unit { blocks } else { blocks.next_multiple_of(unit) };
        PieceSize { blocks, divisor }
    }
}
