//! Pieces of work in flight, and what their completions say of costs.
//!
//! In: pieces as they are submitted, and pieces and frames of the interface as they finish. Out:
//! measurements for [`Cost`]. Some browsers run several pieces as one and report all of them when the
//! last one ends: the first seems to take all of the time, the rest none. Measured one by one, such
//! completions give a piece's fixed cost and the cost of its pixels any value.

use std::collections::VecDeque;

use super::{
    cost::Cost,
    division::Division,
    interface_frames::InterfaceFrames,
    plan::{SampleCost, WorkKind},
    types::{Arithmetic, Phase},
    work::{Trace, Work},
};

/// Largest delay of a merged completion behind the one before.
///
/// Relative to its expected time. Merged completions share their time.
const MERGED_SHARE: f64 = 0.05;

/// Largest share of merged completions among the last ones with which times of single pieces are reliable. Beside a frame of
/// the interface, the time of a piece may be reported as that of another. Where all come in pairs, the share is a half.
const MAX_MERGED: f64 = 0.35;

/// Completions that the share of merged ones is a mean of.
const COMPLETIONS: u32 = 32;

/// Fewest completions that show whether times are reliable.
const FEWEST_COMPLETIONS: u32 = 8;

/// What was expected of a piece in flight.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// What the piece is for.
    pub phase: Phase,
    /// How its kernels raise powers.
    pub arithmetic: Arithmetic,
    /// What its time will be learned as; none of a display, and of a trace whose kind of work has been forgotten since.
    pub learned_as: Option<SampleCost>,
    /// Its estimated GPU time, milliseconds.
    pub expected_ms: f64,
}

/// The pieces of work that have not finished, oldest first.
#[derive(Clone, Debug, Default)]
pub struct InFlight {
    pieces: VecDeque<Piece>,
    are_merged: bool,
    /// Number of completions so far, at most [`COMPLETIONS`].
    completions: u32,
    /// Share of the last ones that arrived together with the one before them, 0 to 1.
    merged_share: f64,
    /// Time of the finished parts of a trace that is submitted in parts, milliseconds.
    parts_ms: f64,
}

/// A piece that has finished.
#[derive(Clone, Copy)]
struct Completion {
    work: Work,
    piece: Piece,
    /// GPU time since the completion before it, milliseconds.
    busy_ms: f64,
}

impl Completion {
    /// Whether it arrived together with the completion before it.
    fn is_merged(&self) -> bool {
        self.busy_ms < MERGED_SHARE * self.piece.expected_ms
    }
}

impl InFlight {
    /// Adds a piece that has been submitted.
    pub fn push(&mut self, piece: Piece) {
        self.pieces.push_back(piece);
    }

    /// Learns nothing from the pieces in flight of these kinds of work, when they end.
    pub fn forget(&mut self, kinds: &[WorkKind]) {
        for piece in &mut self.pieces {
            piece.learned_as.take_if(|cost| kinds.contains(&cost.kind));
        }
    }

    /// Number of pieces.
    pub fn len(&self) -> usize {
        self.pieces.len()
    }

    /// Whether there are no pieces.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Estimated time of the pieces of one phase, milliseconds.
    pub fn expected_ms(&self, phase: Phase) -> f64 {
        self.pieces.iter().filter(|piece| piece.phase == phase).map(|piece| piece.expected_ms).sum()
    }

    /// Whether completions have arrived together at any time.
    pub fn are_merged(&self) -> bool {
        self.are_merged
    }

    /// Whether so few completions of late were merged that their times are those of single pieces.
    pub fn has_reliable_times(&self) -> bool {
        self.completions >= FEWEST_COMPLETIONS && self.merged_share < MAX_MERGED
    }

    /// Removes finished pieces and frames, and learns what they cost.
    ///
    /// `finished`: pieces and frames of the interface (none), in order, each with the GPU time since the completion before
    /// it, milliseconds. Beside pieces, a frame's own time is not what it took: only frames alone are learned from.
    pub fn collect(
        &mut self,
        finished: &[(Option<Work>, f64)],
        frames: &mut InterfaceFrames,
        cost: &mut Cost,
    ) {
        let mut completions = Vec::new();
        for &(work, busy_ms) in finished {
            let Some(work) = work else {
                if frames.ended() {
                    cost.interface_drawn(busy_ms);
                }
                continue;
            };
            // A piece that was never in flight has no estimate to compare with.
            let Some(piece) = self.pieces.pop_front() else { continue };
            let completion = Completion { work, piece, busy_ms };
            let is_merged = f64::from(u8::from(completion.is_merged()));
            self.completions = COMPLETIONS.min(self.completions + 1);
            self.merged_share += (is_merged - self.merged_share) / f64::from(self.completions);
            completions.push(completion);
        }
        for group in completions.chunk_by(|_, next| next.is_merged()) {
            self.are_merged |= group.len() > 1;
            self.learn(cost, group);
        }
    }

    /// Learns from completions that arrived together.
    fn learn(&mut self, cost: &mut Cost, group: &[Completion]) {
        let sum = |value: fn(&Completion) -> f64| group.iter().map(value).sum::<f64>();
        let (busy_ms, expected_ms) = (sum(|it| it.busy_ms), sum(|it| it.piece.expected_ms));
        // Kinds of work share the time in proportion to their estimates.
        let took_ms = |completion: &Completion| match group {
            [_] => busy_ms,
            _ => busy_ms * completion.piece.expected_ms / expected_ms,
        };
        // Traces share theirs equally, as if of one size: shares by estimate would only confirm it.
        let traces: Vec<(Trace, Piece, f64)> = group
            .iter()
            .filter_map(|completion| match completion.work {
                Work::Trace(trace) => Some((trace, completion.piece, took_ms(completion))),
                Work::Display(_) => None,
            })
            .collect();
        let mean = |values: f64| values / traces.len() as f64;
        let samples = mean(traces.iter().map(|(trace, ..)| f64::from(trace.samples())).sum());
        let trace_ms = mean(traces.iter().map(|(.., ms)| ms).sum());
        for (trace, Piece { phase, arithmetic, learned_as, .. }, _) in &traces {
            if let Some(ms) = self.whole_ms(trace, trace_ms, &mut cost.division)
                && let Some(sample_cost) = *learned_as
            {
                cost.traced(sample_cost, *phase, *arithmetic, samples, ms);
            }
        }
        for completion in group.iter().filter(|it| matches!(it.work, Work::Display(_))) {
            cost.displayed(took_ms(completion));
        }
    }

    /// What a trace took as a whole, milliseconds: with the parts before it if it is a part; none before the last part.
    ///
    /// Costs are those of whole traces: the size of pieces does not depend on their parts.
    fn whole_ms(&mut self, trace: &Trace, ms: f64, division: &mut Division) -> Option<f64> {
        let Some(part) = trace.part else { return Some(ms) };
        self.parts_ms = ms + if part.index == 0 { 0.0 } else { self.parts_ms };
        let is_last = part.index + 1 == part.count;
        is_last.then(|| division.learn(part.count, self.parts_ms))
    }
}
