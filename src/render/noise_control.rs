//! Stops path tracing once every pixel reaches the noise target (adaptive sampling).
//!
//! In: complete rounds of samples. Out: the share of pixels that are clean, and whether all are; no call blocks.

use super::path_targets::PathTargets;
use crate::gpu::{Gpu, readback::Readback};

/// The newest assessment, and a pending one.
#[derive(Default)]
pub struct NoiseControl {
    reading: Option<Readback>,
    converged_fraction: Option<f32>,
}

impl NoiseControl {
    /// Share of the pixels that are clean, 0 to 1; none before the first assessment.
    pub fn converged_fraction(&self) -> Option<f32> {
        self.converged_fraction
    }

    /// Whether an assessment is pending.
    pub fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// Begins to read an assessment of the pixels that was submitted just now.
    pub fn begin(&mut self, gpu: &Gpu, paths: &PathTargets) {
        self.reading = Some(Readback::buffer(gpu, &paths.noisy_pixels));
    }

    /// Collects a finished assessment of `pixels`; returns whether all are clean.
    pub fn collect(&mut self, gpu: &Gpu, pixels: u32) -> bool {
        let Some(reading) = &mut self.reading else { return false };
        match reading.take(gpu) {
            Ok(None) => return false,
            Ok(Some(bytes)) => {
                let noisy: u32 = bytemuck::pod_read_unaligned(&bytes[..4]);
                self.converged_fraction = Some(1.0 - noisy as f32 / pixels.max(1) as f32);
            }
            // Other code reports a lost device.
            Err(_) => {}
        }
        self.reading = None;
        self.converged_fraction == Some(1.0)
    }
}
