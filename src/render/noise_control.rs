//! Stops path tracing once every pixel reaches the noise target (adaptive sampling), and reports what the firefly limit
//! takes away.
//!
//! In: complete rounds of samples. Out: the share of pixels that are clean, whether all are, and the part of the light that
//! is lost; no call blocks.

use super::{path_targets::PathTargets, report::ClampedLight};
use crate::gpu::{Gpu, readback::Readback};

/// The newest assessment, and a pending one.
#[derive(Default)]
pub struct NoiseControl {
    reading: Option<Readback>,
    /// Whether samples were added since the newest assessment began.
    is_due: bool,
    converged_fraction: Option<f32>,
    clamped_light: Option<ClampedLight>,
}

impl NoiseControl {
    /// Share of the pixels that are clean, 0 to 1; none before the first assessment.
    pub fn converged_fraction(&self) -> Option<f32> {
        self.converged_fraction
    }

    /// What the firefly limit removed; none before the first assessment.
    pub fn clamped_light(&self) -> Option<ClampedLight> {
        self.clamped_light
    }

    /// Whether an assessment is pending.
    pub fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// Notes that a round of samples is complete.
    pub fn note_round(&mut self) {
        self.is_due = true;
    }

    /// Whether samples await an assessment, and none is pending.
    pub fn is_due(&self) -> bool {
        self.is_due && !self.is_reading()
    }

    /// Begins to read an assessment of the pixels that was submitted just now.
    pub fn begin(&mut self, gpu: &Gpu, paths: &PathTargets) {
        self.is_due = false;
        self.reading = Some(Readback::buffer(gpu, &paths.counts));
    }

    /// Collects a finished assessment of `pixels`; returns whether all are clean.
    pub fn collect(&mut self, gpu: &Gpu, pixels: u32) -> bool {
        let Some(reading) = &mut self.reading else { return false };
        match reading.take(gpu) {
            Ok(None) => return false,
            Ok(Some(bytes)) => {
                let [noisy, light, clamped]: [u32; 3] = bytemuck::pod_read_unaligned(&bytes);
                self.converged_fraction = Some(1.0 - noisy as f32 / pixels.max(1) as f32);
                self.clamped_light =
                    Some(ClampedLight { light: light.into(), clamped: clamped.into() });
            }
            // Other code reports a lost device.
            Err(_) => {}
        }
        self.reading = None;
        self.converged_fraction == Some(1.0)
    }
}
