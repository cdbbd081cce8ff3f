//! In how many parts a long piece is submitted.
//!
//! In: what pieces of few and of many parts took. Out: the parts of the next one. Even the fewest workgroups may take longer
//! than a piece should, with many lights most of it for shadow rays. Each part marches those to some of the lights, and
//! between parts frames of the interface can be drawn. What a part costs beside its rays, in a browser mostly the latency of
//! its completion, is found by trying: a long latency would make parts of a short piece take longer than the piece.

use std::collections::VecDeque;

use super::rate::{self, Measurement};

/// Largest sum of what parts cost beside their rays, in the time of the rays.
const MOST_OVERHEAD: f64 = 0.5;

/// Pieces that the cost of a part is found from.
const PIECES: usize = 32;

/// One of so many pieces has twice as many parts as were tried. Odd: every second piece is half as large as the others.
const TRIAL_PERIOD: u32 = 15;

/// What pieces of few and of many parts took.
#[derive(Clone, Debug, Default)]
pub struct Division {
    /// The parts of the last pieces, and their times together.
    pieces: VecDeque<Measurement>,
    /// Number of pieces so far, modulo 2³².
    issued: u32,
}

impl Division {
    /// The parts of the next piece, at least one and at most `most`.
    ///
    /// `whole_ms`: the expected time of the whole piece. `aim_ms`: what a piece should take.
    pub fn next(&mut self, most: u32, whole_ms: f64, aim_ms: f64) -> u32 {
        self.issued = self.issued.wrapping_add(1);
        let wanted = self.wanted(whole_ms, aim_ms);
        // Pieces of different numbers of parts separate the cost of a part from that of its rays.
        let is_trial = self.issued % TRIAL_PERIOD == 1;
        wanted.saturating_mul(if is_trial { 2 } else { 1 }).min(most)
    }

    /// The parts that are short enough and cost little beside their rays.
    fn wanted(&self, whole_ms: f64, aim_ms: f64) -> u32 {
        let Some(part_ms) = self.part_ms() else { return 1 };
        let rays_ms = whole_ms - part_ms;
        let short_enough = rays_ms / (aim_ms - part_ms).max(0.1 * aim_ms);
        let tried = self.pieces.iter().map(|piece| piece.rays).fold(1.0, f64::max);
        short_enough.ceil().min(MOST_OVERHEAD * rays_ms / part_ms).min(2.0 * tried).max(1.0) as u32
    }

    /// Learns that a piece of so many parts took `ms`, all of them together. Returns what it would have taken undivided.
    pub fn learn(&mut self, parts: u32, ms: f64) -> f64 {
        let parts = f64::from(parts);
        rate::push(&mut self.pieces, PIECES, Measurement { rays: parts, ms });
        let part_ms = self.part_ms().unwrap_or(0.0);
        // Twice as many parts as are wanted cost as much as their rays, at most.
        (ms - (parts - 1.0) * part_ms).max(0.5 * ms)
    }

    /// What a part costs beside its rays, milliseconds.
    fn part_ms(&self) -> Option<f64> {
        rate::line(&self.pieces).map(|(_, part_ms)| part_ms)
    }
}
