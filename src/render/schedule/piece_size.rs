//! How much a refining piece computes.
//!
//! In: the time that a piece aims at, and what rays cost. Out: the piece's workgroups.

use super::{
    cost::Cost,
    types::Pace,
    work::{Job, KeptPixels},
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
pub struct PieceSize {
    /// Number of pieces so far, modulo 2³².
    pieces: u32,
}

impl PieceSize {
    /// Workgroups of the next piece: every second or third one is half as large as the others.
    ///
    /// `kept`: pixels that take no time. `are_merged`: completions have arrived together.
    pub fn next(
        &mut self,
        aim_ms: f64,
        cost: &Cost,
        (job, kept): (Job, KeptPixels),
        are_merged: bool,
    ) -> u32 {
        let computed = f64::from(1.0 - kept.share).max(1e-3);
        let largest = (f64::from(cost.piece_workgroups(aim_ms, job)) / computed) as u32;
        // Pieces of two sizes separate the fixed cost of a piece from that of its pixels. Merged
        // completions are of two pieces, so that only every third piece makes pairs of two sizes.
        self.pieces = self.pieces.wrapping_add(1);
        let period = if are_merged { 3 } else { 2 };
        if self.pieces.is_multiple_of(period) { largest.div_ceil(2) } else { largest }
    }
}
