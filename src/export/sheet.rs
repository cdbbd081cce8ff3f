//! Which pictures one file shows, and where: one, or both eyes' beside or below each other.
//!
//! In: a scene's stereo layout and a size. Out: arithmetic; nothing is drawn here.

use super::{ExportError, MAX_PICTURE_PX, PictureFormat, StillOptions, checked_size};
use crate::{
    render::Eyes,
    scene::{Scene, StereoLayout},
};

/// One of a pair of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eye {
    /// What the left eye is to see.
    Left,
    /// What the right eye is to see.
    Right,
}

impl Eye {
    /// Both, in the order of their files.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// What it adds to a file's name: `_left` or `_right`.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Left => "_left",
            Self::Right => "_right",
        }
    }
}

/// Pictures of one size in columns and rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheet {
    /// Width and height of each picture, pixels.
    pub picture_px: [u32; 2],
    /// Whose pictures, in reading order.
    pub pictures: &'static [Eyes],
    /// How many are beside each other.
    pub columns: u32,
}

impl Sheet {
    /// One picture of `picture_px`.
    #[cfg(test)]
    pub fn single(picture_px: [u32; 2]) -> Self {
        Self { picture_px, pictures: &[Eyes::Camera], columns: 1 }
    }

    /// What a still with `options` shows of `scene`.
    ///
    /// # Errors
    /// [`ExportError::Size`] and [`ExportError::Sheet`] where a side is out of range,
    /// [`ExportError::RedCyanExr`] where there is no such file.
    pub fn new(scene: &Scene, options: &StillOptions) -> Result<Self, ExportError> {
        let picture_px = checked_size(options.size_px)?;
        let layout = scene.camera.stereo.layout;
        let both: &[Eyes] = &[Eyes::Left, Eyes::Right];
        let pictures: &[Eyes] = match (options.eye, layout) {
            (Some(Eye::Left), _) => &[Eyes::Left],
            (Some(Eye::Right), _) => &[Eyes::Right],
            (None, StereoLayout::Off) => &[Eyes::Camera],
            (None, StereoLayout::SideBySide | StereoLayout::TopBottom) => both,
            (None, StereoLayout::Anaglyph) if options.format == PictureFormat::Exr => {
                return Err(ExportError::RedCyanExr);
            }
            (None, StereoLayout::Anaglyph) => &[Eyes::Anaglyph],
        };
        let columns = if options.eye.is_some() { 1 } else { layout.grid()[0] };
        let sheet = Self { picture_px, pictures, columns };
        let sheet_px = sheet.size_px();
        if sheet_px.iter().any(|&side| side > MAX_PICTURE_PX) {
            return Err(ExportError::Sheet { picture_px, sheet_px });
        }
        Ok(sheet)
    }

    /// How many pictures are below each other.
    pub fn rows(&self) -> u32 {
        (self.pictures.len() as u32).div_ceil(self.columns)
    }

    /// Width and height of all, pixels.
    pub fn size_px(&self) -> [u32; 2] {
        let [width, height] = self.picture_px;
        [width * self.columns, height * self.rows()]
    }

    /// Whose pictures are seen to know the sheet as a whole. What each eye sees is part of it
    /// even where the file shows the other one's: both are to be exposed alike.
    pub fn overview_eyes(&self) -> Eyes {
        match self.pictures {
            [Eyes::Left | Eyes::Right, ..] => Eyes::Beside,
            [eyes, ..] => *eyes,
            [] => Eyes::Camera,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(layout: StereoLayout) -> Scene {
        let mut scene = Scene::default();
        scene.camera.stereo.layout = layout;
        scene
    }

    #[test]
    fn sheets_have_room_for_both_eyes() {
        for (layout, expected) in [
            (StereoLayout::Off, [30, 20]),
            (StereoLayout::SideBySide, [60, 20]),
            (StereoLayout::TopBottom, [30, 40]),
            (StereoLayout::Anaglyph, [30, 20]),
        ] {
            let scene = scene(layout);
            let options = StillOptions::new([30, 20]);
            assert_eq!(Sheet::new(&scene, &options).unwrap().size_px(), expected);
            for eye in Eye::BOTH {
                let options = StillOptions { eye: Some(eye), ..options.clone() };
                assert_eq!(Sheet::new(&scene, &options).unwrap().size_px(), [30, 20]);
            }
        }
    }

    #[test]
    fn a_sheet_that_is_too_large_is_refused_with_its_size() {
        let refused = |layout, size_px| {
            let said = Sheet::new(&scene(layout), &StillOptions::new(size_px)).unwrap_err();
            said.to_string()
        };
        let said = refused(StereoLayout::SideBySide, [9000, 100]);
        assert!(said.contains("18000x100") && said.contains("16384"), "{said}");
        assert!(refused(StereoLayout::TopBottom, [100, 8193]).contains("100x16386"));
        let options = StillOptions::new([16_384, 16_384]);
        assert!(Sheet::new(&scene(StereoLayout::Anaglyph), &options).is_ok());
    }
}
