//! The layout of pictures in one file: one picture, or both eyes' side by side or top-bottom.
//!
//! In: a scene's stereo layout and a size. Out: the sheet's pictures and size. This module does
//! not render.

use super::{
    ExportError, Eye, MAX_PICTURE_PX, PictureFormat, StillOptions, checked_size, checked_webp_size,
};
use crate::{
    render::Eyes,
    scene::{Scene, StereoLayout},
};

/// The pictures of one file, all of one size, in columns and rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheet {
    /// Width and height of each picture, pixels.
    pub picture_px: [u32; 2],
    /// The eyes of each picture, in reading order.
    pub pictures: &'static [Eyes],
    /// Number of columns.
    pub columns: u32,
}

impl Sheet {
    /// A sheet with one picture of `picture_px`.
    #[cfg(test)]
    pub fn single(picture_px: [u32; 2]) -> Self {
        Self { picture_px, pictures: &[Eyes::Camera], columns: 1 }
    }

    /// The sheet of a still of `scene` with `options`.
    ///
    /// # Errors
    /// [`ExportError::Size`] and [`ExportError::Sheet`] if a side is out of range,
    /// [`ExportError::WebPSize`] if it is for a WebP, [`ExportError::RedCyanExr`] for an anaglyph as OpenEXR,
    /// [`ExportError::Deep`] for 16 bits of another format than PNG, [`ExportError::Transparent`] and
    /// [`ExportError::TransparentRedCyan`] for a background that cannot be transparent.
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
        if options.is_deep && options.format != PictureFormat::Png {
            return Err(ExportError::Deep);
        }
        if options.is_transparent {
            if !options.format.has_alpha() {
                return Err(ExportError::Transparent);
            }
            if pictures == [Eyes::Anaglyph] {
                return Err(ExportError::TransparentRedCyan);
            }
        }
        if options.format == PictureFormat::WebP {
            checked_webp_size(sheet_px)?;
        }
        Ok(sheet)
    }

    /// Number of rows.
    pub fn rows(&self) -> u32 {
        (self.pictures.len() as u32).div_ceil(self.columns)
    }

    /// Width and height of the whole sheet, pixels.
    pub fn size_px(&self) -> [u32; 2] {
        let [width, height] = self.picture_px;
        [width * self.columns, height * self.rows()]
    }

    /// The eyes of the sheet's overview.
    ///
    /// One file of a pair has an overview of both eyes too, because both files need the same
    /// exposure.
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
    fn the_error_of_a_sheet_that_is_too_large_names_its_size() {
        let error = |layout, size_px| {
            let error = Sheet::new(&scene(layout), &StillOptions::new(size_px)).unwrap_err();
            error.to_string()
        };
        let message = error(StereoLayout::SideBySide, [9000, 100]);
        assert!(message.contains("18000x100") && message.contains("16384"), "{message}");
        assert!(error(StereoLayout::TopBottom, [100, 8193]).contains("100x16386"));
        let options = StillOptions::new([16_384, 16_384]);
        assert!(Sheet::new(&scene(StereoLayout::Anaglyph), &options).is_ok());
    }
}
