//! Finds the pipelines that a view lacks, and decides when to prepare them.

use super::View;
use crate::{
    formula::Kernel,
    render::{
        Pace,
        pipeline_set::{
            self, DENOISE, FILM_PATHS, INDIRECT, MEDIUM, NORMALS, POST, RAYS, SCATTER, SHUTTER,
        },
        pipelines::{PipelineSet, PipelineVariant},
        post::Need,
        preparation::{Preparation, PreparationState},
        schedule::Arithmetic,
    },
    scene::Scene,
};

/// Time without changes after which a view is at rest, in seconds.
const REST_SECS: f64 = 0.3;

impl View {
    /// Prepares missing pipelines: for a still at once, otherwise after announcing them.
    ///
    /// Returns true while no other work should start.
    pub(super) fn prepare(&mut self) -> bool {
        if self.pace == Pace::Still {
            self.pipelines.prepare_together(&self.of_still());
            return false;
        }
        while let Some((variant, is_awaited)) = self.missing() {
            let Some(scene) = self.pending.as_ref().or(self.scene.as_ref()) else { return false };
            let inputs = self.inputs_of(scene);
            let preparation = match self.preparation.take() {
                Some(preparation) if *preparation.variant() == variant => preparation,
                _ => Preparation::announce(variant, self.times.now_secs()),
            };
            let preparation = self.preparation.insert(preparation);
            let now_secs = self.times.now_secs();
            let (pipelines, targets) = (&self.pipelines, &self.targets);
            // Compilations take processor time from what is drawn meanwhile.
            let at_once = match pipelines.gpu.async_compile {
                Some(compile) if !is_awaited => compile.at_once,
                _ => usize::MAX,
            };
            match preparation.step(pipelines, targets, &inputs, at_once, now_secs) {
                PreparationState::Ready => {}
                PreparationState::Background => return is_awaited,
                PreparationState::Foreground => return true,
            }
        }
        self.preparation = None;
        false
    }

    /// All variants that a still needs.
    fn of_still(&self) -> Vec<PipelineVariant> {
        let Some(scene) = self.pending.as_ref().or(self.scene.as_ref()) else { return Vec::new() };
        let always = self.needed(&pipeline_set::ALWAYS);
        self.specialized(scene)
            .into_iter()
            .chain([always])
            .chain(self.behind_shading(scene))
            .collect()
    }

    /// The special variants for a scene.
    fn specialized(&self, scene: &Scene) -> Vec<PipelineVariant> {
        match &self.inputs {
            Some(inputs) if self.pending.is_none() => pipeline_set::specialized(inputs),
            _ => pipeline_set::specialized(&self.inputs_of(scene)),
        }
    }

    /// The variants that a scene needs for indirect light, for light paths and for post passes.
    fn behind_shading(&self, scene: &Scene) -> Vec<PipelineVariant> {
        let has_post = self.lent.post.is_none() && !Need::of_scene(scene).is_none()
            || self.histogram_readback.is_wanted();
        let sets = [
            scene.has_indirect().then_some(&INDIRECT),
            scene.traces_paths().then_some(&FILM_PATHS),
            scene.denoises().then_some(&DENOISE),
            self.sub_frame.is_some().then_some(&SHUTTER),
            has_post.then_some(&POST),
        ];
        sets.into_iter().flatten().map(|set| self.needed(set)).collect()
    }

    /// The general variant of a set without kernels.
    fn needed(&self, set: &'static PipelineSet) -> PipelineVariant {
        PipelineVariant { set, kernel: None, constants: Vec::new() }
    }

    /// The next variant to prepare, and whether the scene cannot be drawn without it.
    fn missing(&self) -> Option<(PipelineVariant, bool)> {
        let scene = self.pending.as_ref().or(self.scene.as_ref())?;
        let rays = self.inputs.iter().flat_map(|inputs| {
            let of_medium = inputs.traces_medium().then_some(&MEDIUM);
            let of_paths = inputs.traces_paths().then_some(&SCATTER);
            let sets = [&RAYS, &NORMALS].into_iter().chain(of_medium).chain(of_paths);
            sets.map(|set| PipelineVariant::of(set, inputs))
        });
        // A general variant draws until the special variant is ready; deep views have no general variant.
        let drawn_by = rays.map(|special| special.general().unwrap_or(special));
        let awaited: Vec<_> = drawn_by.chain(self.behind_shading(scene)).collect();
        // A finished picture leaves time for later needs, if asynchronous compilation blocks nothing.
        let is_free = self.pipelines.gpu.async_compile.is_some()
            && self.pace == Pace::Interactive
            && self.is_at_rest()
            && self.schedule.status(self.times.now_secs()).idle;
        let others = self.special_to_prepare(scene).into_iter();
        let later = if is_free { self.of_later() } else { Vec::new() };
        let awaited = awaited.into_iter().map(|variant| (variant, true));
        let all = awaited.chain(others.chain(later).map(|variant| (variant, false)));
        let mut missing = all.filter(|(variant, _)| !self.pipelines.is_ready(variant));
        missing.next()
    }

    /// Variants that may be needed soon: indirect light, post passes, and those of a dive near an anchor.
    fn of_later(&self) -> Vec<PipelineVariant> {
        let mut later = vec![self.needed(&INDIRECT), self.needed(&POST)];
        if let (Some(inputs), Some(space)) = (&self.inputs, &self.space)
            && self.anchors.are_near()
        {
            let (kernel, fractal) = (inputs.formula.kernel, space.model().fractal());
            for variant in kernel.formula.dive_variants(fractal, kernel.variant) {
                let kernel = Kernel { variant, ..kernel };
                later.extend(
                    [&RAYS, &NORMALS].map(|set| PipelineVariant::with_kernel(set, inputs, kernel)),
                );
            }
        }
        later
    }

    /// The special variant that is due: only at rest, since a drag passes through many.
    ///
    /// A preparation that has begun is finished in any case.
    fn special_to_prepare(&self, scene: &Scene) -> Option<PipelineVariant> {
        let begun = self.preparation.as_ref().filter(|preparation| preparation.has_begun());
        let begun = begun.map(Preparation::variant);
        let is_due = self.is_at_rest();
        if !is_due && begun.is_none() {
            return None;
        }
        let is_wanted = |variant: &PipelineVariant| is_due || begun == Some(variant);
        self.specialized(scene)
            .into_iter()
            .find(|variant| is_wanted(variant) && !self.pipelines.is_ready(variant))
    }

    /// The arithmetic that rays compute orbits with.
    pub(super) fn arithmetic(&self) -> Arithmetic {
        let Some(inputs) = &self.inputs else { return Arithmetic::Real };
        let kernel = inputs.formula.kernel;
        if kernel.is_deep() {
            Arithmetic::Deep
        } else if kernel.is_general() {
            Arithmetic::Real
        } else if self.pipelines.has_own(&PipelineVariant::of(&RAYS, inputs)) {
            Arithmetic::SpecializedPipeline
        } else {
            Arithmetic::Whole
        }
    }

    /// Whether a picture is shown and nothing has changed for [`REST_SECS`].
    fn is_at_rest(&self) -> bool {
        self.pending.is_none()
            && self.schedule.status(self.times.now_secs()).shown
            && !self.moving
            && self.times.unchanged_secs() >= REST_SECS
    }
}
