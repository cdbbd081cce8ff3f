//! A view's status, the times of its work, and the GPU memory that it holds.

use super::{PieceTime, View};
use crate::render::{
    memory::Memory,
    report::{Activity, Report},
    targets::texture_bytes,
};

impl View {
    /// The view's status.
    pub fn report(&self) -> Report {
        let status = self.schedule.status(self.times.now_secs());
        // Once jittered samples are on the film, the centre samples are not.
        let replaced = if status.samples_done > 1 { self.replaced_samples() } else { 0 };
        let activity = if let Some(preparation) = &self.preparation {
            Activity::Compiling(preparation.variant().name())
        } else if self.inputs.is_none() || (status.idle && self.pending.is_none()) {
            Activity::Idle
        } else if status.moving {
            Activity::Moving
        } else {
            Activity::Refining
        };
        Report {
            activity,
            size_px: self.region.display_px(),
            samples_done: status.samples_done - replaced,
            samples_so_far: status.samples_so_far - replaced as f32,
            samples_wanted: self.scene.as_ref().map_or(1, |scene| scene.quality.samples),
            pixels_per_sample: 1 << status.shown_level,
            converged_fraction: self.converged_fraction(),
            clamped_light: self.clamped_light(),
            elapsed_secs: self.times.elapsed_secs(),
            frame_ms: self.times.frame_ms,
            frame_interval_secs: self.schedule.frame_interval_secs(),
            anchor_ms: self.anchors.took_ms(),
            histogram: self.histogram_readback.histogram().cloned(),
            memory: self.memory(),
            pictures: self.times.pictures,
        }
    }

    /// Sets whether the GPU times of pieces of work are recorded, for measurements.
    pub fn watch_piece_times(&mut self, wanted: bool) {
        self.times.watch_pieces(wanted);
    }

    /// The GPU times of the pieces of work that have finished since the last call.
    ///
    /// None unless [`Self::watch_piece_times`] has begun to record them. The view learns from them, as in [`Self::pump`].
    pub fn take_piece_times(&mut self) -> Vec<PieceTime> {
        self.collect();
        self.times.take_pieces()
    }

    /// The view's GPU memory.
    fn memory(&self) -> Memory {
        let mut memory = self.targets.memory();
        if let Some(shown) = self.shown.older_than(&self.targets) {
            memory.display += texture_bytes(shown);
        }
        memory
    }
}
