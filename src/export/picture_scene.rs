//! The scene document of a picture in any format that can store one.

use std::io::Cursor;

use super::{
    exr::{exr_scene_text, is_exr},
    jpeg::{is_jpeg, jpeg_scene_text},
    png::{is_png, scene_text},
    webp::{is_webp, webp_scene_text},
};

/// The scene document of a picture: PNG, JPEG, WebP or OpenEXR; none if `bytes` begin as no picture does.
///
/// A picture without a document is `Some(Ok(None))`. `bytes` may end within the pixels.
///
/// # Errors
/// Inside the option, a message for the user; the content of `bytes` is untrusted.
pub fn picture_scene_text(bytes: &[u8]) -> Option<Result<Option<String>, String>> {
    Some(if is_png(bytes) {
        scene_text(Cursor::new(bytes)).map_err(|error| error.to_string())
    } else if is_jpeg(bytes) {
        jpeg_scene_text(bytes).map_err(|error| error.to_string())
    } else if is_webp(bytes) {
        webp_scene_text(bytes).map_err(|error| error.to_string())
    } else if is_exr(bytes) {
        exr_scene_text(Cursor::new(bytes))
    } else {
        return None;
    })
}
