//! How pieces of work make room for frames of the interface.
//!
//! Now and then a frame has the GPU to itself and is measured. A frame beside pieces of work can't be: browsers count most of
//! its time as the piece before or after it. After input, a frame waits for one long piece instead of two.

use std::collections::VecDeque;

use super::types::{MAX_IN_FLIGHT, Phase};

/// Largest part of GPU time that frames of the interface take which only report progress.
pub const FRAME_SHARE: f64 = 0.1;

/// Frames between two measured ones.
const FRAMES_BETWEEN: u32 = 16;

/// Frames that are measured at first: one can be held up.
const FIRST_MEASURED: u32 = 2;

/// Longest time that work waits for a frame, seconds: a page out of sight draws none.
const MAX_HOLD_SECS: f64 = 3.0;

/// Seconds after input during which one long piece is in flight: a click can take some frames.
const ANSWER_SECS: f64 = 0.3;

/// Time of the pieces in flight above which they delay a frame noticeably, milliseconds. Below it two are in flight, since
/// one at a time leaves the GPU idle until its completion is known.
const LONG_MS: f64 = 12.0;

/// The interface's frames in flight, and whether work waits for one.
#[derive(Clone, Debug, Default)]
pub struct InterfaceFrames {
    /// Since when no work is handed out; none while work goes on.
    held_since_secs: Option<f64>,
    /// For each frame that has not ended, oldest first: whether it has the GPU to itself.
    in_flight: VecDeque<bool>,
    /// Number of measured frames.
    measured: u32,
    /// Frames since the last measured one.
    since_measured: u32,
    /// When the last input was; none before the first.
    input_at_secs: Option<f64>,
}

impl InterfaceFrames {
    /// Whether work waits for a frame at `now_secs`.
    pub fn is_holding(&self, now_secs: f64) -> bool {
        self.held_since_secs.is_some_and(|since| now_secs - since < MAX_HOLD_SECS)
    }

    /// Notes input that someone waits for the answer of, such as a click.
    pub fn note_input(&mut self, now_secs: f64) {
        self.input_at_secs = Some(now_secs);
    }

    /// Most pieces in flight at `now_secs`, where those in flight take `in_flight_ms`.
    ///
    /// The first picture of a change always has two, with its display.
    pub fn max_in_flight(&self, phase: Phase, in_flight_ms: f64, now_secs: f64) -> usize {
        let is_answering = self.input_at_secs.is_some_and(|at| now_secs - at < ANSWER_SECS);
        if self.is_holding(now_secs) {
            0
        } else if is_answering && phase == Phase::Refining && in_flight_ms > LONG_MS {
            1
        } else {
            MAX_IN_FLIGHT
        }
    }

    /// Lets work go on: no frame is measured.
    pub fn release(&mut self) {
        self.held_since_secs = None;
        self.in_flight.iter_mut().for_each(|is_alone| *is_alone = false);
    }

    /// Requests a frame that reports progress. Returns whether it may be drawn now.
    ///
    /// One that is to be measured waits until all work has ended. `is_refining`: a picture at rest has work left.
    /// `is_free`: no work is in flight.
    pub fn request(&mut self, is_refining: bool, is_free: bool, now_secs: f64) -> bool {
        if self.held_since_secs.is_some() && !self.is_holding(now_secs) {
            // None came: after the next ones that do come, it is tried again.
            self.release();
            (self.measured, self.since_measured) = (FIRST_MEASURED, 0);
        }
        if !is_refining {
            self.release();
        } else if self.is_due() && self.held_since_secs.is_none() {
            self.held_since_secs = Some(now_secs);
        }
        !self.is_holding(now_secs) || (is_free && self.in_flight.is_empty())
    }

    /// Notes that a frame has been submitted. `is_free`: no work is in flight, of this picture or another.
    pub fn submitted(&mut self, is_free: bool, now_secs: f64) {
        let is_alone = is_free && self.is_holding(now_secs) && self.in_flight.is_empty();
        self.in_flight.push_back(is_alone);
    }

    /// Whether the next frame is to be measured.
    fn is_due(&self) -> bool {
        self.measured < FIRST_MEASURED || self.since_measured >= FRAMES_BETWEEN
    }

    /// Notes that the oldest frame has ended. Returns whether it had the GPU to itself.
    pub fn ended(&mut self) -> bool {
        let was_alone = self.in_flight.pop_front().unwrap_or(false);
        if was_alone {
            // Work may follow now, beside any frame after this one.
            self.release();
            self.measured = self.measured.saturating_add(1);
            self.since_measured = 0;
        } else {
            self.since_measured = self.since_measured.saturating_add(1);
        }
        was_alone
    }
}
