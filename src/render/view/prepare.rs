//! Which pipelines a view lacks, and when it sees to them.

use super::View;
use crate::{
    render::{
        Pace,
        glow::Need,
        kernels::Extra,
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
        while let Some((extra, is_awaited)) = self.missing() {
            if self.pace == Pace::Still {
                self.kernels.prepare(extra);
                continue;
            }
            let Some(scene) = self.pending.as_ref().or(self.scene.as_ref()) else { return false };
            let inputs = self.inputs_of(scene);
            let preparation = match self.preparation.take() {
                Some(preparation) if preparation.extra() == extra => preparation,
                _ => Preparation::announce(extra, self.now_secs),
            };
            let preparation = self.preparation.insert(preparation);
            match preparation.step(&self.kernels, &self.targets, &inputs, self.now_secs) {
                Progress::Ready => {}
                Progress::Aside => return is_awaited,
                Progress::Alone => return true,
            }
        }
        self.preparation = None;
        false
    }

    /// The pipelines that are to be prepared now, if any, and whether the scene cannot be drawn
    /// without them.
    fn missing(&self) -> Option<(Extra, bool)> {
        let scene = self.pending.as_ref().or(self.scene.as_ref())?;
        let gathers = scene.indirect.kind != IndirectKind::Off;
        let glows = self.lent_glow.is_none() && !Need::of_scene(scene).is_none();
        let awaited = [
            gathers.then_some(Extra::Gather),
            (glows || self.watch.is_wanted()).then_some(Extra::Glow),
        ];
        // General pipelines do as well until a power has its own. A finished picture leaves time
        // for what may come, where that holds nothing up.
        let is_free = self.kernels.gpu.aside.is_some()
            && self.pace == Pace::Interactive
            && self.is_at_rest()
            && self.schedule.status(self.now_secs).idle;
        let others = [
            self.power_to_prepare(scene),
            is_free.then_some(Extra::Gather),
            is_free.then_some(Extra::Glow),
        ];
        let awaited = awaited.into_iter().map(|extra| (extra, true));
        let all = awaited.chain(others.into_iter().map(|extra| (extra, false)));
        all.filter_map(|(extra, is_awaited)| Some((extra?, is_awaited)))
            .find(|(extra, _)| !self.kernels.is_ready(*extra))
    }

    /// The power whose own pipelines are due: for a still at once, otherwise at rest, for a drag
    /// passes through many. What has begun is finished.
    fn power_to_prepare(&self, scene: &Scene) -> Option<Extra> {
        let extra = Extra::Power(scene.fractal.integer_power()?);
        let has_begun = self
            .preparation
            .as_ref()
            .is_some_and(|preparation| preparation.extra() == extra && preparation.has_begun());
        (self.pace == Pace::Still || self.is_at_rest() || has_begun).then_some(extra)
    }

    /// Whether a picture has been shown, and nothing has changed for a while.
    fn is_at_rest(&self) -> bool {
        self.pending.is_none()
            && self.schedule.status(self.now_secs).shown
            && !self.moving
            && self.now_secs - self.changed_secs >= REST_SECS
    }
}
