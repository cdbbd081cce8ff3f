//! In how many parts a long piece is submitted.
//!
//! In: what pieces of few and of many parts took. Out: the parts of the next one. Even the smallest piece may take longer
//! than it should, with many lights most of it for shadow rays. Each part marches those to some of the lights, and
//! between parts frames of the interface can be drawn. What a part costs beside its rays, in a browser mostly the latency of
//! its completion, is its overhead. It is found by trying: with a long latency, the parts of a piece take longer than the piece.

use std::collections::VecDeque;

use super::rate::{self, Measurement};

/// Largest overhead of all parts together, in the time of their rays.
const MAX_OVERHEAD: f64 = 0.5;

/// Pieces that the overhead of a part is found from.
const PIECES: usize = 32;

/// One of so many pieces is a trial, with another number of parts. Odd, so that trials are not all half as large as other
/// pieces, as every second piece is.
const TRIAL_PERIOD: u32 = 15;

/// The same among the first [`PIECES`]: one trial says little, since other rays take another time.
const FIRST_TRIAL_PERIOD: u32 = 3;

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
        let wanted = self.wanted(whole_ms, aim_ms).min(most);
        let is_known = self.pieces.len() == PIECES;
        let period = if is_known { TRIAL_PERIOD } else { FIRST_TRIAL_PERIOD };
        if self.issued % period != 1 {
            return wanted;
        }
        // Pieces of different numbers of parts separate the overhead of a part from the time of its rays.
        if 2 * wanted <= most { 2 * wanted } else { (wanted / 2).max(1) }
    }

    /// The parts that are short enough and cost little beside their rays.
    fn wanted(&self, whole_ms: f64, aim_ms: f64) -> u32 {
        let Some(overhead_ms) = self.overhead_ms() else { return 1 };
        let rays_ms = whole_ms - overhead_ms;
        let short_enough = rays_ms / (aim_ms - overhead_ms).max(0.1 * aim_ms);
        let tried = self.pieces.iter().map(|piece| piece.rays).fold(1.0, f64::max);
        short_enough.ceil().min(MAX_OVERHEAD * rays_ms / overhead_ms).min(2.0 * tried).max(1.0)
            as u32
    }

    /// Learns that a piece of so many parts took `ms`, all of them together. Returns what it would have taken undivided.
    pub fn learn(&mut self, parts: u32, ms: f64) -> f64 {
        let parts = f64::from(parts);
        rate::push(&mut self.pieces, PIECES, Measurement { rays: parts, ms });
        let overhead_ms = self.overhead_ms().unwrap_or(0.0);
        // Twice as many parts as are wanted cost as much as their rays, at most.
        (ms - (parts - 1.0) * overhead_ms).max(0.5 * ms)
    }

    /// Expected time of one of so many parts of a piece that takes `whole_ms` undivided, milliseconds.
    pub fn part_ms(&self, parts: u32, whole_ms: f64) -> f64 {
        let overhead_ms = self.overhead_ms().unwrap_or(0.0).min(whole_ms);
        (whole_ms - overhead_ms) / f64::from(parts) + overhead_ms
    }

    /// What a part costs beside its rays, milliseconds.
    fn overhead_ms(&self) -> Option<f64> {
        rate::line(&self.pieces).map(|(_, overhead_ms)| overhead_ms)
    }
}
