//! What a picture in tiles has to know of itself as a whole.
//!
//! In: the scene, and what the file shows. Out: a small picture of all of it, drawn first, by
//! whose exposure and bloom every tile is then shown, and from which it gathers indirect light. A
//! picture that depends on nothing of the kind has no overview, and pays nothing.

use std::sync::Arc;

use super::{PictureFormat, sheet::Sheet};
use crate::{
    render::{
        Eyes, MAX_REGION_PX, Pace, Pipelines, Region, View, post::Need, uniforms::FrameUniforms,
    },
    scene::{EnvironmentMap, IndirectKind, Scene},
};

/// Most pixels of an overview, both eyes' together: those of 1920×1080, so that pictures up to
/// that size are seen as they are, and it costs little beside larger ones.
const MOST_PIXELS: f64 = 1920.0 * 1080.0;

/// Most samples a pixel of a large picture. Means and blurs are over so many of its pixels that
/// more samples of each change little.
const MOST_SAMPLES: u32 = 4;

/// So many samples of all pixels together are taken in any case, where the scene has them: a
/// small picture's pixels are too few to make up for it.
const LEAST_SAMPLES_IN_ALL: f64 = 1e6;

/// The whole picture, seen small.
pub(super) struct Overview {
    view: View,
    samples: u32,
    has_post: bool,
    has_indirect: bool,
    is_finished: bool,
}

impl Overview {
    /// The overview of a file of `format` that shows `scene`; none where no tile needs one.
    pub fn new(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        environment_map: Option<&Arc<EnvironmentMap>>,
        sheet: &Sheet,
        format: PictureFormat,
    ) -> Option<Self> {
        let region = region(sheet.picture_px, sheet.overview_eyes());
        let has_indirect = scene.indirect.kind != IndirectKind::Off;
        // An EXR holds what is before exposure and bloom.
        let has_post =
            format != PictureFormat::Exr && !Need::of(&FrameUniforms::new(scene, region)).is_none();
        if !has_post && !has_indirect {
            return None;
        }
        let mut scene = scene.clone();
        let enough = (LEAST_SAMPLES_IN_ALL / pixels(region)) as u32;
        // Indirect light is gathered from centre samples alone.
        let enough = if has_post { enough.max(MOST_SAMPLES) } else { 1 };
        let samples = scene.quality.samples.min(enough);
        scene.quality.samples = samples;
        let mut view = View::new(pipelines, region, Pace::Still);
        view.set_environment_map(environment_map);
        view.set_scene(&scene, false);
        Some(Self { view, samples, has_post, has_indirect, is_finished: false })
    }

    /// Draws on, without waiting. True once all is known.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        self.is_finished = self.is_finished || !self.view.pump(now_secs);
        self.is_finished
    }

    /// Whether all is known.
    pub fn is_finished(&self) -> bool {
        self.is_finished
    }

    /// Gives the view of a tile what it is shown by, once all is known.
    pub fn lend_to(&self, tile: &mut View) {
        if self.has_post {
            tile.lend_post(Some(self.view.post()));
        }
        if self.has_indirect {
            tile.lend_indirect_source(Some(self.view.indirect_source()));
        }
    }

    /// Samples of all its pixels.
    pub fn samples(&self) -> f64 {
        pixels(self.view.region()) * f64::from(self.samples)
    }

    /// Part of them that have been drawn, 0 to 1.
    pub fn part_done(&self) -> f64 {
        let done = f64::from(self.view.report().samples_done) / f64::from(self.samples);
        if self.is_finished { 1.0 } else { done.min(1.0) }
    }
}

/// A picture of nearly the shape of `picture_px`, no larger, that an overview shows.
fn region(picture_px: [u32; 2], eyes: Eyes) -> Region {
    let size = picture_px.map(f64::from);
    let most_pixels = MOST_PIXELS / f64::from(eyes.count());
    let most_side = f64::from(MAX_REGION_PX / eyes.count());
    let scale = (most_pixels / (size[0] * size[1])).sqrt();
    let scale = scale.min(most_side / size[0].max(size[1])).min(1.0);
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
    fn overviews_are_small_and_keep_the_shape() {
        for eyes in [Eyes::Camera, Eyes::Beside, Eyes::Anaglyph] {
            for picture_px in
                [[1, 1], [1920, 1080], [16_384, 16_384], [16_384, 9216], [16_384, 1], [3, 16_384]]
            {
                let small = region(picture_px, eyes);
                assert!(small.fits() && pixels(small) <= 1.001 * MOST_PIXELS, "{small:?}");
                assert_eq!(small.picture_px, small.size_px);
                let [width, height] = picture_px.map(f64::from);
                let [small_width, small_height] = small.size_px.map(f64::from);
                // Half a pixel of either side.
                let off = (small_width / width - small_height / height).abs();
                let is_a_line = small_height.min(small_width) <= 1.0;
                assert!(is_a_line || off <= 0.5 / width + 0.5 / height + 1e-9, "{small:?}");
            }
        }
        assert_eq!(region([1920, 1080], Eyes::Camera).size_px, [1920, 1080]);
    }
}
