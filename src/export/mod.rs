//! Pictures to keep: stills of any size, rendered tile by tile and written as PNG.
//!
//! In: [`crate::render::Pipelines`], a scene, a size in pixels and something to write to. Out:
//! the file's bytes, in order, while the picture is still being made. Nothing here holds a
//! whole picture, opens a file, or waits for the GPU (but for [`still::StillJob::run`], which
//! says so): the same job runs in a page and in a terminal.
//!
//! | file | what lives there |
//! |---|---|
//! | [`still`] | the job: render a tile, read it back, hand its rows on |
//! | [`sequence`] | the frames of a camera path, one still each |
//! | [`archive`] | a zip of files, written while they come |
//! | `sheet` | which pictures one file shows, and where |
//! | `overview` | what a picture in tiles has to know of itself as a whole |
//! | `tiles` | how a sheet is cut |
//! | `format` | the kinds of file, and what each wants of a tile |
//! | [`mod@exr`] | linear pixels with depth, normal and position to an OpenEXR file |
//! | [`png`] | rows to a PNG that carries its scene, and the scene out of one |

pub mod archive;
pub mod exr;
mod format;
mod overview;
pub mod png;
pub mod sequence;
mod sheet;
pub mod still;
mod tiles;

pub use archive::Archive;
pub use exr::{exr_scene_text, is_exr};
pub use format::PictureFormat;
pub use png::{MAX_TEXT_BYTES, PngError, is_png, scene_text};
pub use sequence::{SequenceJob, frame_name};
pub use sheet::Eye;
pub use still::{StillJob, StillOptions, StillStatus};

use crate::scene::Invalid;

/// Largest width or height of a picture, in pixels.
pub const MAX_PICTURE_PX: u32 = 16_384;

/// Why a picture was not made.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A side is zero or above [`MAX_PICTURE_PX`].
    #[error("a picture of {}x{} pixels: both sides must be from 1 to {MAX_PICTURE_PX}", .0[0], .0[1])]
    Size([u32; 2]),
    /// Both eyes' pictures in one file have a side above [`MAX_PICTURE_PX`].
    #[error("both eyes' pictures of {}x{} pixels make a file of {}x{}: no side may be above {MAX_PICTURE_PX}; a smaller size, or a pair of files, fits", .picture_px[0], .picture_px[1], .sheet_px[0], .sheet_px[1])]
    Sheet {
        /// Width and height of one eye's picture.
        picture_px: [u32; 2],
        /// Those of both together.
        sheet_px: [u32; 2],
    },
    /// Linear light of both eyes cannot share an OpenEXR file's channels.
    #[error(
        "a red-cyan anaglyph mixes what both eyes see, and is no OpenEXR file: choose PNG, side by side, top-bottom or a pair"
    )]
    RedCyanExr,
    /// The scene, or the samples asked for, are out of range.
    #[error(transparent)]
    Scene(#[from] Invalid),
    /// The path has no keys, or none of the frames asked for.
    #[error("the camera path has no such frames")]
    NoFrames,
    /// The destination took no more bytes.
    #[error("the picture could not be written: {0}")]
    Write(#[from] std::io::Error),
    /// The PNG encoder refused its input.
    #[error("the PNG encoder failed: {0}")]
    Encode(String),
    /// The device was lost or reported an error.
    #[error("the GPU failed: {0}")]
    Gpu(String),
    /// Whoever watched the job ended it.
    #[error("cancelled")]
    Cancelled,
}

/// `size_px` where both sides are from 1 to [`MAX_PICTURE_PX`].
///
/// # Errors
/// [`ExportError::Size`].
pub fn checked_size(size_px: [u32; 2]) -> Result<[u32; 2], ExportError> {
    if size_px.iter().all(|side| (1..=MAX_PICTURE_PX).contains(side)) {
        Ok(size_px)
    } else {
        Err(ExportError::Size(size_px))
    }
}
