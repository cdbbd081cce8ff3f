//! Small pictures of the opening scenes and dives, for their buttons.
//!
//! In: a preset. Out: its picture as an image of egui, which loads it when it is first shown. The
//! program around the interface decodes: a browser has a decoder, and another one would make the
//! page's module larger than the pictures do.

use egui::Image;
use include_dir::{Dir, include_dir};

use crate::scene::presets::Preset;

/// Width and height of every thumbnail, in pixels.
pub const SIZE_PX: [u32; 2] = [192, 120];

/// The files that `cargo xtask thumbnails` renders.
static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/src/ui/thumbnails");

/// The JPEG file of a preset's thumbnail, if there is one.
pub fn jpeg(preset: &Preset) -> Option<&'static [u8]> {
    Some(FILES.get_file(file_name(preset))?.contents())
}

/// The thumbnail of a preset for display.
pub(super) fn image(preset: &Preset) -> Option<Image<'static>> {
    Some(Image::from_bytes(format!("bytes://{}", file_name(preset)), jpeg(preset)?))
}

/// The name of a thumbnail's file.
fn file_name(preset: &Preset) -> String {
    format!("{}.jpg", preset.id())
}
