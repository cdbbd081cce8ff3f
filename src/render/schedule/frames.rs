//! Frames of the interface, which share the GPU with the picture: now and then one has the GPU to itself, to be measured.
//!
//! Beside pieces of work a frame cannot be measured: browsers count most of its time as the piece before or after it.

use std::collections::VecDeque;

use super::{Schedule, types::Pace};

/// Frames beside pieces of work, between two that are measured.
const FRAMES_BETWEEN: u32 = 16;

/// The frames of the interface that have not ended, and whether the next one is to be measured.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// True while no work is handed out, for a frame to have the GPU to itself.
    is_held: bool,
    /// For each frame that has not ended, oldest first: whether it has the GPU to itself.
    in_flight: VecDeque<bool>,
    /// Frames since the last measured one; none before the first.
    since_measured: Option<u32>,
}

impl Frames {
    /// Whether no work may be handed out.
    pub fn hold_work(&self) -> bool {
        self.is_held
    }

    /// Whether it is time to measure one.
    pub fn is_due(&self) -> bool {
        self.since_measured.is_none_or(|frames| frames >= FRAMES_BETWEEN)
    }

    /// Holds work back until a frame has ended that has the GPU to itself.
    pub fn hold(&mut self) {
        self.is_held = true;
    }

    /// Lets work go on: no frame is measured.
    pub fn release(&mut self) {
        self.is_held = false;
        self.in_flight.iter_mut().for_each(|is_alone| *is_alone = false);
    }

    /// Notes that a frame has been submitted. `is_free`: no work is in flight.
    pub fn submitted(&mut self, is_free: bool) {
        self.in_flight.push_back(self.is_held && is_free);
    }

    /// Notes that the oldest frame has ended, and returns whether it had the GPU to itself.
    pub fn ended(&mut self) -> bool {
        let was_alone = self.in_flight.pop_front().unwrap_or(false);
        if was_alone {
            self.is_held = false;
            self.since_measured = Some(0);
        } else {
            self.since_measured = self.since_measured.map(|frames| frames.saturating_add(1));
        }
        was_alone
    }
}

impl Schedule {
    /// Makes way for a frame of the interface that reports progress. Returns whether it may be drawn now.
    ///
    /// Where frames are due to be measured, no work is handed out until the work in flight and then the frame have ended.
    pub fn make_way_for_frame(&mut self, now_secs: f64) -> bool {
        let is_refining = self.pace == Pace::Interactive
            && !self.opening
            && !self.follows(now_secs)
            && !self.status(now_secs).idle;
        if is_refining && self.frames.is_due() {
            self.frames.hold();
        }
        !self.frames.hold_work() || self.in_flight.is_empty()
    }

    /// Hands out work again although no frame of the interface came.
    pub fn end_wait_for_frame(&mut self) {
        self.frames.release();
    }

    /// Notes that a frame of the interface has been submitted.
    pub fn note_frame(&mut self) {
        self.frames.submitted(self.in_flight.is_empty());
    }
}
