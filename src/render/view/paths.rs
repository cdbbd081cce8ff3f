//! What changes in a view when light paths are traced: the noise at which its picture ends, and what happens when jittered samples replace the direct picture of its centre samples.

use super::View;
use crate::{
    render::{
        Pace,
        pass::assess_noise,
        recorder::Recorder,
        schedule::{Points, Trace, Work},
        uniforms::Inputs,
    },
    scene::Scene,
};

/// Samples over which light paths replace the direct picture: the noise of each step is below that of the last.
const PREVIEW_SAMPLES: u32 = 64;

impl View {
    /// Assesses the noise of all pixels if `work` completes a round of samples, unless the last one is awaited.
    pub(super) fn assess_noise(&mut self, work: Work) {
        let Some(inputs) = self.inputs.as_ref().filter(|inputs| inputs.frame.paths.noise > 0.0)
        else {
            return;
        };
        let Work::Trace(Trace { points: Points::Samples { .. }, .. }) = work else { return };
        if !self.schedule.is_between_samples() || self.noise_control.is_reading() {
            return;
        }
        let gpu = &self.pipelines.gpu;
        let paths = &self.targets.paths;
        gpu.queue.write_buffer(&paths.noisy_pixels, 0, &0_u32.to_le_bytes());
        let passes = self.pipelines.of_frame(inputs);
        let (layouts, dispatches) = (&self.pipelines.layouts, &mut self.dispatches);
        let mut recorder = Recorder::new(layouts, &passes, &self.targets, inputs, dispatches);
        assess_noise::record(&mut recorder);
        gpu.queue.submit([recorder.finish()]);
        self.noise_control.begin(gpu, paths);
    }

    /// Ends the picture once all pixels are clean.
    pub(super) fn end_at_noise(&mut self) {
        let pixels = self.region.film_px().iter().product();
        if self.noise_control.collect(&self.pipelines.gpu, pixels) && self.clean_part().is_some() {
            self.schedule.set_clean(true);
        }
    }

    /// Share of the pixels that are clean; none without a noise target.
    pub(super) fn clean_part(&self) -> Option<f32> {
        let has_target = self.inputs.as_ref().is_some_and(|inputs| inputs.frame.paths.noise > 0.0);
        self.noise_control.clean_part().filter(|_| has_target)
    }

    /// Number of samples over which light paths replace the direct picture: none for stills.
    pub(super) fn preview_samples(&self, scene: &Scene) -> u32 {
        match self.pace {
            Pace::Interactive => scene.quality.samples.min(PREVIEW_SAMPLES),
            Pace::Still => 0,
        }
    }

    /// Number of samples of a pixel that leave the film when others take their place.
    pub(super) fn replaced_samples(&self) -> u32 {
        u32::from(self.inputs.as_ref().is_some_and(Inputs::replaces_center_samples))
    }
}
