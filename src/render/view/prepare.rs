//! Which pipelines a view lacks, and when it sees to them.

use super::View;
use crate::{
    render::{
        Pace,
        pipelines::{Depth, PipelineKey, PipelineVariant},
        post::Need,
        preparation::{Preparation, Progress},
    },
    scene::{IndirectKind, Scene},
};

/// Nothing has changed for so long where a view is at rest, seconds.
const REST_SECS: f64 = 0.3;

impl View {
    /// Sees to it that pipelines are there before anything needs them: for a still at once,
    /// otherwise after saying so. True while nothing else should start.
    pub(super) fn prepare(&mut self) -> bool {
        if self.pace == Pace::Still {
            self.pipelines.prepare_together(&self.of_still());
            return false;
        }
        while let Some((variant, is_awaited)) = self.missing() {
            let Some(scene) = self.pending.as_ref().or(self.scene.as_ref()) else { return false };
            let inputs = self.inputs_of(scene);
            let preparation = match self.preparation.take() {
                Some(preparation) if preparation.variant() == variant => preparation,
                _ => Preparation::announce(variant, self.now_secs),
            };
            let preparation = self.preparation.insert(preparation);
            match preparation.step(&self.pipelines, &self.targets, &inputs, self.now_secs) {
                Progress::Ready => {}
                Progress::Background => return is_awaited,
                Progress::Foreground => return true,
            }
        }
        self.preparation = None;
        false
    }

    /// All pipelines beside the general forms that a still needs.
    fn of_still(&self) -> Vec<PipelineVariant> {
        let Some(scene) = self.pending.as_ref().or(self.scene.as_ref()) else { return Vec::new() };
        let behind_shading = self.behind_shading(scene).into_iter().flatten();
        self.special(scene).into_iter().chain(behind_shading).collect()
    }

    /// The special forms of the passes that draw a scene.
    fn special(&self, scene: &Scene) -> [PipelineVariant; 4] {
        match &self.inputs {
            Some(inputs) if self.pending.is_none() => PipelineVariant::special(&inputs.frame),
            _ => PipelineVariant::special(&self.inputs_of(scene).frame),
        }
    }

    /// What a scene needs of indirect light and of the passes over the whole film.
    fn behind_shading(&self, scene: &Scene) -> [Option<PipelineVariant>; 2] {
        let has_indirect = scene.indirect.kind != IndirectKind::Off;
        let has_post = self.lent_post.is_none() && !Need::of_scene(scene).is_none();
        [
            has_indirect.then_some(PipelineVariant::Indirect),
            (has_post || self.histogram_readback.is_wanted()).then_some(PipelineVariant::Post),
        ]
    }

    /// The pipelines that are to be prepared now, if any, and whether the scene cannot be drawn
    /// without them.
    fn missing(&self) -> Option<(PipelineVariant, bool)> {
        let scene = self.pending.as_ref().or(self.scene.as_ref())?;
        // There is no general form of what is drawn from an anchor.
        let deep = self.inputs.as_ref().filter(|inputs| inputs.frame.fractal.reference_points > 0);
        let [rays, normals, ..] = match deep {
            Some(inputs) => PipelineVariant::special(&inputs.frame).map(Some),
            None => [None; 4],
        };
        let awaited = [rays, normals].into_iter().chain(self.behind_shading(scene));
        // General forms do as well until there are special ones. A finished picture leaves time
        // for what may come, where that holds nothing up.
        let is_free = self.pipelines.gpu.async_compile.is_some()
            && self.pace == Pace::Interactive
            && self.is_at_rest()
            && self.schedule.status(self.now_secs).idle;
        let others = [
            self.special_to_prepare(scene),
            is_free.then_some(PipelineVariant::Indirect),
            is_free.then_some(PipelineVariant::Post),
        ];
        let dive = if is_free { self.of_dive() } else { Vec::new() };
        let others = others.into_iter().chain(dive.into_iter().map(Some));
        let awaited = awaited.map(|variant| (variant, true));
        let all = awaited.chain(others.map(|variant| (variant, false)));
        all.filter_map(|(variant, is_awaited)| Some((variant?, is_awaited)))
            .find(|(variant, _)| !self.pipelines.is_ready(*variant))
    }

    /// What a dive is going to need, once there may be one.
    fn of_dive(&self) -> Vec<PipelineVariant> {
        let inputs = self.inputs.as_ref().filter(|_| self.anchors.are_near());
        let Some(inputs) = inputs.filter(|inputs| inputs.frame.fractal.rotates == 0) else {
            return Vec::new();
        };
        let power = PipelineKey::of(&inputs.frame).power;
        let of = |depth| {
            let key = PipelineKey { power, depth };
            [PipelineVariant::Rays(key), PipelineVariant::Normals(key, inputs.frame.normals)]
        };
        Depth::DIVE.into_iter().flat_map(of).collect()
    }

    /// The special forms of passes that are due: at rest, for a drag passes through many. What has
    /// begun is finished.
    fn special_to_prepare(&self, scene: &Scene) -> Option<PipelineVariant> {
        let begun = self.preparation.as_ref().filter(|preparation| preparation.has_begun());
        let begun = begun.map(Preparation::variant);
        let is_due = self.is_at_rest();
        if !is_due && begun.is_none() {
            return None;
        }
        let is_wanted = |variant: &PipelineVariant| is_due || begun == Some(*variant);
        self.special(scene)
            .into_iter()
            .find(|variant| is_wanted(variant) && !self.pipelines.is_ready(*variant))
    }

    /// Whether a picture has been shown, and nothing has changed for a while.
    fn is_at_rest(&self) -> bool {
        self.pending.is_none()
            && self.schedule.status(self.now_secs).shown
            && !self.moving
            && self.now_secs - self.changed_secs >= REST_SECS
    }
}
