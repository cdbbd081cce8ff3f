//! Overview: a small rendering of the whole picture, before its tiles.
//!
//! Auto exposure, bloom, indirect light and gradients that follow the view depend on the whole picture.
//! The overview provides all four to every tile. A picture without these effects has no overview and no extra cost.

use std::sync::Arc;

use super::{
    PictureFormat,
    motion::{SubFrameView, SubFrames},
    sheet::Sheet,
};
use crate::{
    render::{
        Eyes, MAX_REGION_PX, Pipelines, Region, View, display_values::DisplayValues, post::Need,
    },
    scene::{EnvironmentMap, Scene},
};

/// Maximum number of pixels of an overview, both eyes together.
///
/// Pictures up to 1920×1080 have an overview of full size; for larger ones its cost is small.
const MAX_PIXELS: f64 = 1920.0 * 1080.0;

/// Maximum samples per pixel of a large overview.
///
/// Means and blurs average many pixels, so more samples change the result little.
const MAX_SAMPLES: u32 = 4;

/// Minimum number of samples, summed over all pixels, if the scene's quality allows it.
///
/// A small picture averages few pixels, so each pixel needs more samples.
const MIN_TOTAL_SAMPLES: f64 = 1e6;

/// A small rendering of the whole picture.
pub(super) struct Overview {
    view: SubFrameView,
    samples: u32,
    has_post: bool,
    has_indirect: bool,
    has_colors: bool,
}

impl Overview {
    /// The overview for a file of `scene`, drawn by `sub_frames`; none if no effect needs the whole picture.
    pub fn new(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        sub_frames: &SubFrames,
        environment_map: Option<&Arc<EnvironmentMap>>,
        sheet: &Sheet,
        format: PictureFormat,
    ) -> Option<Self> {
        let region = region(sheet.picture_px, sheet.overview_eyes());
        // Traced paths have no screen-space indirect light.
        let has_indirect = scene.has_indirect() && !scene.traces_paths();
        // An OpenEXR file stores radiance before exposure and bloom.
        let has_post = format != PictureFormat::Exr && !Need::of_scene(scene).is_none();
        let has_colors = scene.surface.follows_view();
        if !has_post && !has_indirect && !has_colors {
            return None;
        }
        let min_samples = (MIN_TOTAL_SAMPLES / pixels(region)) as u32;
        // Indirect light and colours read the centre samples only.
        let enough_samples = if has_post { min_samples.max(MAX_SAMPLES) } else { 1 };
        let samples = scene.quality.samples.min(enough_samples);
        // Nobody sees the overview itself.
        let sub_frames = sub_frames.reduced(samples, |scene| scene.integrator.denoise = false);
        let values = DisplayValues::default();
        let view = SubFrameView::new(pipelines, region, environment_map, sub_frames, values);
        Some(Self { view, samples, has_post, has_indirect, has_colors })
    }

    /// Continues the rendering without waiting. True if the overview is complete.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        !self.view.pump(now_secs)
    }

    /// True if the overview is complete.
    pub fn is_finished(&self) -> bool {
        self.view.is_finished()
    }

    /// Lends exposure, bloom, indirect light and the colour curve to the view of a tile.
    pub fn lend_to(&self, tile: &mut View) {
        let view = self.view.view();
        if self.has_post {
            tile.lend_post(Some(view.post()));
        }
        if self.has_indirect {
            tile.lend_indirect_source(Some(view.indirect_source()));
        }
        if self.has_colors {
            tile.lend_color_curves(view.color_curves());
        }
    }

    /// Number of samples, summed over all pixels.
    pub fn samples(&self) -> f64 {
        pixels(self.view.view().region()) * f64::from(self.samples)
    }

    /// Rendered fraction of the samples, 0 to 1.
    pub fn part_done(&self) -> f64 {
        self.view.part_done()
    }
}

/// The overview's region: `picture_px` scaled down to the limits, with nearly the same aspect.
fn region(picture_px: [u32; 2], eyes: Eyes) -> Region {
    let size = picture_px.map(f64::from);
    let max_pixels = MAX_PIXELS / f64::from(eyes.count());
    let max_side = f64::from(MAX_REGION_PX / eyes.count());
    let scale = (max_pixels / (size[0] * size[1])).sqrt();
    let scale = scale.min(max_side / size[0].max(size[1])).min(1.0);
    let whole = Region::whole(size.map(|side| ((side * scale).round() as u32).max(1)));
    Region { eyes, ..whole }
}

fn pixels(region: Region) -> f64 {
    region.film_px().map(f64::from).iter().product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overviews_are_within_the_limits_and_keep_the_aspect() {
        for eyes in [Eyes::Camera, Eyes::Beside, Eyes::Anaglyph] {
            for picture_px in
                [[1, 1], [1920, 1080], [16_384, 16_384], [16_384, 9216], [16_384, 1], [3, 16_384]]
            {
                let small = region(picture_px, eyes);
                assert!(small.fits() && pixels(small) <= 1.001 * MAX_PIXELS, "{small:?}");
                assert_eq!(small.picture_px, small.size_px);
                let [width, height] = picture_px.map(f64::from);
                let [small_width, small_height] = small.size_px.map(f64::from);
                // Each side is rounded by half a pixel at most.
                let error = (small_width / width - small_height / height).abs();
                let is_a_line = small_height.min(small_width) <= 1.0;
                assert!(is_a_line || error <= 0.5 / width + 0.5 / height + 1e-9, "{small:?}");
            }
        }
        assert_eq!(region([1920, 1080], Eyes::Camera).size_px, [1920, 1080]);
    }
}
