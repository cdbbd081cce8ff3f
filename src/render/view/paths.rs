//! Path tracing in a view: noise target, and replacement of centre samples.

use super::View;
use crate::{
    gpu::host_shared::HostShared,
    render::{
        Pace,
        pass::assess_noise,
        recorder::Recorder,
        report::ClampedLight,
        schedule::{KeptPixels, Points, Trace, Work},
        uniforms::{Inputs, PathCounts},
    },
    scene::Scene,
};

/// Samples over which light paths replace the direct picture: the noise of each step is below that of the last.
const PREVIEW_SAMPLES: u32 = 64;

/// Samples from which a pixel may get no more.
const CONVERGED_SAMPLES: u32 = assess_noise::MIN_ROUNDS * assess_noise::SAMPLES_PER_ROUND;

impl View {
    /// Lets the paths of a film that was taken over be assessed, as after a round.
    pub(super) fn note_reused_rounds(&mut self) {
        if self.assesses() {
            self.noise_control.note_round();
        }
    }

    /// Clears the counts of paths before `work` if it begins a picture of which no pixel is kept.
    pub(super) fn clear_path_counts(&self, work: Work) {
        if let Work::Trace(Trace {
            points: Points::Samples { first: 1, .. },
            first_block: 0,
            kept: KeptPixels { share: 0.0, .. },
            ..
        }) = work
        {
            let queue = &self.pipelines.gpu.queue;
            queue.write_buffer(&self.targets.paths.counts, 0, &PathCounts::default().to_bytes());
        }
    }

    /// Notes that `work` completes a round of samples, if it does.
    pub(super) fn note_round(&mut self, work: Work) {
        let is_of_samples =
            matches!(work, Work::Trace(Trace { points: Points::Samples { .. }, .. }));
        if is_of_samples && self.schedule.is_between_samples() && self.assesses() {
            self.noise_control.note_round();
        }
        self.assess_noise();
    }

    /// Whether the paths of the picture have a noise target or a limit.
    fn assesses(&self) -> bool {
        self.inputs.as_ref().is_some_and(|inputs| {
            let paths = &inputs.frame.paths;
            paths.noise > 0.0 || paths.firefly_limit > 0.0
        })
    }

    /// Assesses the paths of the newest rounds, unless an assessment is pending.
    fn assess_noise(&mut self) {
        let Some(inputs) = self.inputs.as_ref().filter(|_| self.noise_control.is_due()) else {
            return;
        };
        let gpu = &self.pipelines.gpu;
        let paths = &self.targets.paths;
        if inputs.frame.paths.noise > 0.0 {
            gpu.queue.write_buffer(&paths.counts, 0, &0_u32.to_le_bytes());
            let passes = self.pipelines.of_frame(inputs);
            let (layouts, dispatches) = (&self.pipelines.layouts, &mut self.dispatches);
            let mut recorder = Recorder::new(layouts, &passes, &self.targets, inputs, dispatches);
            assess_noise::record(&mut recorder);
            gpu.queue.submit([recorder.finish()]);
        }
        self.noise_control.begin(gpu, paths);
    }

    /// Ends the picture once all pixels are clean.
    pub(super) fn end_at_noise(&mut self) {
        let pixels = self.region.film_px().iter().product();
        if self.noise_control.collect(&self.pipelines.gpu, pixels)
            && self.converged_fraction().is_some()
        {
            self.schedule.set_converged(true);
        }
        self.assess_noise();
    }

    /// What the firefly limit took away; none without a limit.
    pub(super) fn clamped_light(&self) -> Option<ClampedLight> {
        let has_limit =
            self.inputs.as_ref().is_some_and(|inputs| inputs.frame.paths.firefly_limit > 0.0);
        self.noise_control.clamped_light().filter(|_| has_limit)
    }

    /// Share of the pixels that are clean; none without a noise target.
    pub(super) fn converged_fraction(&self) -> Option<f32> {
        let has_target = self.inputs.as_ref().is_some_and(|inputs| inputs.frame.paths.noise > 0.0);
        self.noise_control.converged_fraction().filter(|_| has_target)
    }

    /// Number of samples over which light paths replace the direct picture: none for stills.
    ///
    /// Not more than pixels have that get no more samples, and not more than before once the direct picture is gone.
    pub(super) fn preview_samples(&self, scene: &Scene) -> u32 {
        if self.pace == Pace::Still {
            return 0;
        }
        let has_target = scene.integrator.noise > 0.0;
        let most = if has_target { CONVERGED_SAMPLES } else { PREVIEW_SAMPLES };
        let before = self.inputs.as_ref().map_or(0.0, |old| old.frame.paths.preview_samples) as u32;
        let done = self.schedule.status(self.times.now_secs()).samples_done;
        let is_gone = before > 0 && done.max(self.schedule.kept_samples()) > before;
        if is_gone { before } else { scene.quality.samples.min(most) }
    }

    /// Whether a display shows denoised light: if it is wanted, and every pixel has a path.
    pub(super) fn denoises(&self) -> bool {
        /// The centre sample, which paths replace, and one path.
        const SAMPLES: u32 = 2;
        let is_wanted = self.inputs.as_ref().is_some_and(|inputs| inputs.frame.paths.denoise != 0);
        is_wanted && self.schedule.status(self.times.now_secs()).samples_done >= SAMPLES
    }

    /// Number of samples of a pixel that leave the film when others take their place.
    pub(super) fn replaced_samples(&self) -> u32 {
        u32::from(self.inputs.as_ref().is_some_and(Inputs::replaces_center_samples))
    }
}
