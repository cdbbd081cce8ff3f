//! Readback of the film's histogram, while the interface shows it.
//!
//! In: the statistics of each new picture. Out: the newest histogram; nothing here waits.

use super::{post, report::Histogram};
use crate::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
};

/// The newest histogram, and a readback in flight.
#[derive(Default)]
pub struct HistogramReadback {
    is_wanted: bool,
    reading: Option<Readback>,
    /// There has been another picture since the reading began.
    is_stale: bool,
    histogram: Option<Histogram>,
}

impl HistogramReadback {
    /// Starts without a histogram.
    pub fn new(is_wanted: bool) -> Self {
        Self { is_wanted, ..Self::default() }
    }

    /// Whether somebody looks.
    pub fn is_wanted(&self) -> bool {
        self.is_wanted
    }

    /// Whether an answer is on its way.
    pub fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// The newest one; none before the first, and where it is not wanted.
    pub fn histogram(&self) -> Option<&Histogram> {
        self.histogram.as_ref()
    }

    /// There is another picture.
    pub fn note_picture(&mut self) {
        self.is_stale = true;
    }

    /// Fetches the histogram of the newest picture from its statistics.
    pub fn read(&mut self, gpu: &Gpu, statistics: &wgpu::Buffer) {
        if let Some(reading) = &mut self.reading {
            match reading.take(gpu) {
                Ok(None) => return,
                Ok(Some(bytes)) => self.histogram = post::histogram(&bytes),
                // A lost device says so elsewhere.
                Err(ReadbackError) => {}
            }
            self.reading = None;
        }
        if self.is_wanted && std::mem::take(&mut self.is_stale) {
            self.reading = Some(Readback::buffer(gpu, statistics));
        }
    }
}
