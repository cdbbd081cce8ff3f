//! Reads back the film's histogram while the interface shows it.
//!
//! In: the statistics of each new picture. Out: the newest histogram; no call blocks.

use super::{post, report::Histogram};
use crate::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
};

/// The newest histogram, and a pending readback.
#[derive(Default)]
pub struct HistogramReadback {
    is_wanted: bool,
    reading: Option<Readback>,
    /// True if another picture was drawn since the readback began.
    is_stale: bool,
    histogram: Option<Histogram>,
}

impl HistogramReadback {
    /// A readback without a histogram yet.
    pub fn new(is_wanted: bool) -> Self {
        Self { is_wanted, ..Self::default() }
    }

    /// Whether the interface shows the histogram.
    pub fn is_wanted(&self) -> bool {
        self.is_wanted
    }

    /// Whether a readback is pending.
    pub fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// The newest histogram; none before the first, and while not wanted.
    pub fn histogram(&self) -> Option<&Histogram> {
        self.histogram.as_ref()
    }

    /// Notes that there is a new picture.
    pub fn note_picture(&mut self) {
        self.is_stale = true;
    }

    /// Collects a finished readback and starts the next, if the picture is newer.
    pub fn read(&mut self, gpu: &Gpu, statistics: &wgpu::Buffer) {
        if let Some(reading) = &mut self.reading {
            match reading.take(gpu) {
                Ok(None) => return,
                Ok(Some(bytes)) => self.histogram = post::histogram(&bytes),
                // Other code reports a lost device.
                Err(ReadbackError) => {}
            }
            self.reading = None;
        }
        if self.is_wanted && std::mem::take(&mut self.is_stale) {
            self.reading = Some(Readback::buffer(gpu, statistics));
        }
    }
}
