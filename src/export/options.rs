//! The options of a still: size, eye, samples, tiles, environment map and file format.

use std::sync::Arc;

use super::{
    format::{FileEncoding, PictureFormat},
    jpeg::DEFAULT_QUALITY,
};
use crate::{
    render::display_values::DisplayValues,
    scene::{EnvironmentMap, Scene, StereoLayout},
};

/// Default maximum size of a tile, in pixels: wide, so that bands are thin.
const TILE_PX: [u32; 2] = [2048, 256];

/// The eye of one file of a stereo pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eye {
    /// The file for the left eye.
    Left,
    /// The file for the right eye.
    Right,
}

impl Eye {
    /// Both eyes, in the order of their files.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Suffix of the eye's file name: `_left` or `_right`.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Left => "_left",
            Self::Right => "_right",
        }
    }
}

/// The options of a still: size, eye, samples, tiles, environment map and file format.
#[derive(Clone, Debug)]
pub struct StillOptions {
    /// Width and height of one eye's picture, in pixels: each 1 to [`super::MAX_PICTURE_PX`].
    /// The same limit applies to a file with both eyes' pictures.
    pub size_px: [u32; 2],
    /// The eye, for one file of a stereo pair; none for the scene's stereo layout.
    pub eye: Option<Eye>,
    /// Samples per pixel, range [`crate::scene::param::SAMPLES`]; none for the scene's number.
    pub samples: Option<u32>,
    /// Maximum width and height of a tile. Smaller tiles need less memory, larger tiles less
    /// time; the picture is the same.
    pub tile_px: [u32; 2],
    /// The loaded environment map, if any.
    pub environment_map: Option<Arc<EnvironmentMap>>,
    /// The file format.
    pub format: PictureFormat,
    /// Quality of a JPEG, 1 to 100.
    pub quality: u8,
    /// True for 16 bits per channel of a PNG, instead of 8.
    pub is_deep: bool,
    /// True for a transparent background, of PNG, WebP and OpenEXR. Each pixel then gets all samples: a noise target is ignored.
    pub is_transparent: bool,
    /// Whether path-traced light is denoised. None: as the scene says, but OpenEXR not.
    pub denoise: Option<bool>,
}

impl StillOptions {
    /// Options for a PNG of `size_px` with the scene's number of samples.
    pub fn new(size_px: [u32; 2]) -> Self {
        Self {
            size_px,
            eye: None,
            samples: None,
            tile_px: TILE_PX,
            environment_map: None,
            format: PictureFormat::default(),
            quality: DEFAULT_QUALITY,
            is_deep: false,
            is_transparent: false,
            denoise: None,
        }
    }

    /// How the file stores pixels.
    pub(super) fn file(&self) -> FileEncoding {
        FileEncoding {
            format: self.format,
            quality: self.quality,
            values: DisplayValues { is_deep: self.is_deep, is_transparent: self.is_transparent },
        }
    }

    /// Whether a still of `scene` is denoised.
    pub fn denoises(&self, scene: &Scene) -> bool {
        let is_for_eyes = self.format != PictureFormat::Exr;
        scene.traces_paths() && self.denoise.unwrap_or(is_for_eyes && scene.integrator.denoise)
    }

    /// The scene that a still of `scene` shows and stores in its file.
    ///
    /// Samples and stereo layout follow these options. Each file of a stereo pair stores the scene
    /// with the side-by-side layout.
    pub fn shown(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        if let Some(samples) = self.samples {
            scene.quality.samples = samples;
        }
        if self.eye.is_some() {
            scene.camera.stereo.layout = StereoLayout::SideBySide;
        }
        scene
    }
}
