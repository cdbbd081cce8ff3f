//! Another region for a view, which keeps what is true of the samples of the old one.
//!
//! A window that becomes wider shows more beside the same pixels: their samples are moved to their new places, and
//! only the others are computed.

use super::{StatsValidity, View, drawable};
use crate::render::{
    Pace,
    region::Region,
    reuse::{self, Sized},
    space,
    targets::Targets,
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
        let has_space = match (&self.scene, &self.space) {
            (Some(scene), Some(space)) => {
                space::wants_anchor(space.model(), scene, region) == space.reference().is_some()
            }
            _ => false,
        };
        let old_width_px = self.region.size_px[0];
        let overlap = region.overlap(&self.region).filter(|_| has_space && self.can_keep_samples());
        let light_reach_px = self.light_reach_px(region);
        let old_targets = self.fit_region(region);
        let keeps = self.schedule.resize(region.film_px(), overlap, light_reach_px);
        self.times.note_change();
        let (Some(scene), Some(space)) = (&self.scene, &self.space) else { return };
        if !has_space {
            // The new pixel size needs another render space.
            self.is_space_current = false;
            self.pending = self.pending.take().or_else(|| self.scene.clone());
            self.inputs = None;
            return;
        }
        self.upload(self.inputs_about(scene, space));
        if let (Some(overlap), Some(old)) = (overlap.filter(|_| keeps), old_targets) {
            let old = Sized { targets: &old, width_px: old_width_px };
            let new = Sized { targets: &self.targets, width_px: region.size_px[0] };
            reuse::copy_samples(&self.pipelines.gpu, old, new, &overlap);
            // Whether the kept pixels are clean is known once they are assessed.
            self.noise_control.note_round();
        }
    }

    /// Replaces the buffers by those of `region`, and returns the old ones; none if they have its size.
    fn fit_region(&mut self, region: Region) -> Option<Targets> {
        // Two regions of one size can hold different eye layouts, so discard the film statistics.
        self.stats_validity = StatsValidity::default();
        let same_size = region.size_px == self.region.size_px
            && region.film_px() == self.region.film_px()
            && region.display_px() == self.region.display_px();
        let old = (!same_size).then(|| {
            let environment_texture = self.targets.environment_texture.clone();
            let targets =
                Targets { environment_texture, ..Targets::new(&self.pipelines.layouts, region) };
            std::mem::replace(&mut self.targets, targets)
        });
        self.region = region;
        self.fit_display();
        old
    }

    /// Whether samples may stay over a change of size: not those of stills, which are the same from any
    /// beginning, nor of tiles.
    fn can_keep_samples(&self) -> bool {
        self.pace == Pace::Interactive
            && self.sub_frame.is_none()
            && self.lent.post.is_none()
            && self.lent.indirect_source.is_none()
    }

    /// How far around a pixel its light comes from, in pixels; none if all the film's light depends on the size.
    ///
    /// Backgrounds follow the picture's height, and indirect light comes from a pixel's neighbours.
    fn light_reach_px(&self, region: Region) -> Option<u32> {
        /// A neighbour's place in its pixel, and that of the sample.
        const ROUNDING_PX: f64 = 2.0;
        let inputs = self.inputs.as_ref()?;
        let height = region.size_px[1];
        let reach = if inputs.has_indirect() {
            (f64::from(inputs.frame.indirect.radius) * f64::from(height) + ROUNDING_PX).ceil()
        } else {
            0.0
        };
        (height == self.region.size_px[1]).then_some(reach as u32)
    }
}
