//! Whether a frame's file that is there is complete, and of its sequence.

use std::{
    fs::{self, File},
    io::{self, BufReader, Read as _},
    path::Path,
};

use mandelight::{
    export::{self, PictureFormat, StillOptions},
    scene::{Path as CameraPath, document},
};
use serde_json::Value;

use super::folder::FrameFile;

/// What is known of a frame's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// There is none.
    Missing,
    /// The frame.
    Complete,
    /// No complete picture: what a crash of the machine or a full disk leaves.
    Damaged,
    /// A complete picture of another size or scene, or no file at all.
    Foreign,
}

/// Checks the file of a frame: its format, that it has its last bytes, its size in pixels and its scene; the pixels of
/// PNGs, whose chunks have checksums.
///
/// # Errors
/// Those of reading the file.
pub fn check(
    file: &Path,
    (frame, eye): FrameFile,
    path: &CameraPath,
    options: &StillOptions,
) -> io::Result<Kept> {
    match fs::metadata(file) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Kept::Missing),
        // Opening anything but a file might wait.
        Ok(metadata) if !metadata.is_file() => return Ok(Kept::Foreign),
        metadata => metadata?,
    };
    let options = StillOptions { eye, ..options.clone() };
    let open = || File::open(file).map(BufReader::new);
    let size = match options.format {
        PictureFormat::Exr => export::exr_complete_size(open()?).ok(),
        PictureFormat::Jpeg => export::jpeg_complete_size(open()?).ok(),
        PictureFormat::WebP => export::webp_complete_size(open()?).ok(),
        PictureFormat::Png | PictureFormat::Rgb => export::png_complete_size(open()?).ok(),
    };
    let mut start = Vec::new();
    File::open(file)?.take(export::MAX_HEADER_BYTES as u64).read_to_end(&mut start)?;
    let text = export::picture_scene_text(&start).and_then(Result::ok).flatten();
    let (Some(Some(size)), Some(scene)) = (size, path.frame(frame)) else {
        return Ok(Kept::Damaged);
    };
    let shown = options.shown(&scene);
    // Values, because one character may be written in several ways.
    let value = |text: &str| serde_json::from_str::<Value>(text).ok();
    let is_scene =
        text.is_some_and(|text| value(&text) == value(&document::to_json_compact(&shown)));
    let is_size = options.sheet_px(&shown).is_ok_and(|expected| expected == size);
    if !is_scene || !is_size {
        return Ok(Kept::Foreign);
    }
    let is_png = matches!(options.format, PictureFormat::Png | PictureFormat::Rgb);
    Ok(if is_png && !export::png_has_all_pixels(open()?) { Kept::Damaged } else { Kept::Complete })
}
