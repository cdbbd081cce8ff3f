//! How much a refining piece computes.
//!
//! In: pace, motion budget and what rays cost. Out: the workgroups of the next piece.

use super::{
    cost::Cost,
    types::Pace,
    work::{Job, KeptPixels, MAX_PIECE_WORKGROUPS},
};

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

/// Sizes of successive refining pieces.
#[derive(Clone, Debug, Default)]
pub struct PieceSizes {
    /// Number of pieces so far, modulo 2³².
    issued: u32,
}

/// The size of a piece.
#[derive(Clone, Copy, Debug)]
pub struct PieceSize {
    /// How many workgroups, at most [`MAX_PIECE_WORKGROUPS`].
    pub workgroups: u32,
    /// What the workgroups of larger pieces are divided by: 2 for a piece of half the size, else 1.
    pub divisor: u32,
}

impl PieceSizes {
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
        let computed = f64::from(1.0 - kept.share).max(1e-3);
        let wanted = (f64::from(cost.piece_workgroups(aim_ms, job)) / computed) as u32;
        let largest = wanted.min(MAX_PIECE_WORKGROUPS);
        // Pieces of two sizes separate the fixed cost of a piece from that of its pixels. Merged
        // completions are of two pieces, so that only every third piece makes pairs of two sizes.
        self.issued = self.issued.wrapping_add(1);
        if self.issued.is_multiple_of(if are_merged { 3 } else { 2 }) {
            PieceSize { workgroups: largest.div_ceil(2), divisor: 2 }
        } else {
            PieceSize { workgroups: largest, divisor: 1 }
        }
    }
}
