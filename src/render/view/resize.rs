//! Another region for a view, which keeps what is true of the old picture.
//!
//! A window that becomes wider shows more beside the same pixels: their samples are moved to their new places, and
//! only the others are computed.

use super::{StatsValidity, View, drawable};
use crate::render::{
    Pace,
    region::{Overlap, Region},
    reuse::{self, Film},
    schedule::{Reuse, Stale},
    space,
    targets::Targets,
    uniforms::Inputs,
};

impl View {
    /// Changes the rectangle; allocates new buffers if its size differs.
    ///
    /// While someone is watching, pixels that the old picture had too keep their samples.
    pub fn set_region(&mut self, region: Region) {
        let region = drawable(region);
        if region == self.region {
            return;
        }
        self.finish_display();
        let old_region = std::mem::replace(&mut self.region, region);
        if region.film_px() != old_region.film_px() {
            self.display_division.forget_times();
        }
        self.times.note_change();
        let inputs = self.inputs_in_same_space();
        let overlap = inputs.as_ref().and_then(|inputs| self.overlap(inputs, old_region));
        let indirect_radius_px = inputs.as_ref().map_or(0, Inputs::indirect_radius_px);
        let old_targets = self.fit_targets(old_region);
        let reuse = self.schedule.resize(region.film_px(), overlap, indirect_radius_px);
        let Some(inputs) = inputs else {
            if self.inputs.take().is_some() {
                // The new pixel size needs another render space.
                self.is_space_current = false;
                self.pending = self.pending.take().or_else(|| self.scene.clone());
            }
            return;
        };
        self.upload(inputs);
        if let (Some(overlap), Some(targets)) = (overlap, old_targets)
            && reuse != Reuse::Nothing
        {
            let old = Film { targets: &targets, width_px: old_region.size_px[0] };
            let new = Film { targets: &self.targets, width_px: region.size_px[0] };
            reuse::copy_samples(&self.pipelines.gpu, old, new, &overlap);
        }
        if reuse == Reuse::Film {
            self.note_reused_rounds();
        }
    }

    /// The scene's inputs in the new region; none if it needs another render space.
    fn inputs_in_same_space(&self) -> Option<Inputs> {
        self.inputs.as_ref()?;
        let (scene, space) = (self.scene.as_ref()?, self.space.as_ref()?);
        let wants_anchor = space::wants_anchor(space.model(), scene, self.region);
        (wants_anchor == space.reference().is_some()).then(|| self.inputs_about(scene, space))
    }

    /// The pixels whose samples may stay; none if anything but the width is new.
    ///
    /// Stills and tiles must not depend on earlier sizes.
    fn overlap(&self, inputs: &Inputs, old_region: Region) -> Option<Overlap> {
        let is_alone = self.lent.post.is_none() && self.lent.indirect_source.is_none();
        let is_watched = self.pace == Pace::Interactive && self.sub_frame.is_none() && is_alone;
        let old = self.inputs.as_ref().filter(|_| is_watched)?;
        let stale = inputs.stale_but_for_width(old);
        self.region.overlap(&old_region).filter(|_| stale <= Some(Stale::Tone))
    }

    /// Replaces the buffers by those of the region, and returns the old ones; none if their size is the same.
    fn fit_targets(&mut self, old_region: Region) -> Option<Targets> {
        // Two regions of one size can hold different eye layouts, so discard the film statistics.
        self.stats_validity = StatsValidity::default();
        let sizes = |region: Region| (region.size_px, region.film_px(), region.display_px());
        let old = (sizes(self.region) != sizes(old_region)).then(|| {
            let environment_texture = self.targets.environment_texture.clone();
            let targets = Targets::new(&self.pipelines.layouts, self.region);
            std::mem::replace(&mut self.targets, Targets { environment_texture, ..targets })
        });
        self.fit_display();
        old
    }
}
