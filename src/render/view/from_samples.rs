//! A still view that reuses the finished samples of another view.
//!
//! Such as for a file of the picture on the screen.

use std::sync::Arc;

use super::View;
use crate::{
    render::{
        Pace,
        display_values::DisplayValues,
        region::Overlap,
        reuse::{self, Film},
        schedule::{Reuse, Stale},
    },
    scene::{EnvironmentMap, Scene},
};

impl View {
    /// A still of `scene` with the samples of this view, which it only displays.
    ///
    /// None if the samples of `scene` are others, or this view lacks some of them. This view may change afterwards.
    pub fn still_of_samples(
        &self,
        scene: &Scene,
        environment_map: Option<&Arc<EnvironmentMap>>,
        display_values: DisplayValues,
    ) -> Option<Self> {
        let is_whole = self.lent.post.is_none()
            && self.lent.indirect_source.is_none()
            && self.sub_frame.is_none();
        if !self.has_all_samples_of(scene) || !is_whole || self.waits_for_colors() {
            return None;
        }
        let mut still = Self::new(&self.pipelines, self.region, Pace::Still);
        still.display_values = display_values;
        still.fit_display();
        still.environment_map = environment_map.cloned();
        still.sky_cache = self.sky_cache.clone();
        still.space.clone_from(&self.space);
        still.is_space_current = self.is_space_current;
        still.colors.lent = self.color_curves();
        // The lights keep the visibility bits of the samples.
        still.inputs.clone_from(&self.inputs);
        still.apply(scene.clone());
        still.copy_samples_of(self).then_some(still)
    }

    /// Whether the view is finished, with as many samples as `scene` asks for.
    fn has_all_samples_of(&self, scene: &Scene) -> bool {
        let (report, Some(own)) = (self.report(), &self.scene) else { return false };
        // A noise target is of the displayed light.
        let target = |scene: &Scene| (scene.integrator.noise, scene.tone.exposure);
        let is_converged = report.converged_fraction == Some(1.0) && target(scene) == target(own);
        // The film can't be reduced to fewer samples.
        report.is_finished()
            && report.samples_wanted == scene.quality.samples
            && (report.samples_done >= report.samples_wanted || is_converged)
    }

    /// Copies the samples of `other`; false if they are not those of this view's picture.
    fn copy_samples_of(&mut self, other: &Self) -> bool {
        let (Some(new), Some(old)) = (&self.inputs, &other.inputs) else { return false };
        if new.stale_since(old).is_some_and(|stale| stale > Stale::Tone) {
            return false;
        }
        let size_px = self.region.film_px();
        let whole = Overlap { first: [0, 0], first_in_old: [0, 0], size_px };
        if self.schedule.copy_progress(&other.schedule, whole) != Reuse::Film {
            return false;
        }
        let [from, to] =
            [other, &*self].map(|view| Film { targets: &view.targets, width_px: size_px[0] });
        reuse::copy_samples(&self.pipelines.gpu, from, to, &whole);
        self.note_reused_rounds();
        true
    }
}
