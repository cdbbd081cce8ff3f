//! Why an export failed, and the largest pictures.

use crate::scene::Invalid;

/// Largest width or height of a picture, in pixels.
pub const MAX_PICTURE_PX: u32 = 16_384;

/// Largest width or height of a WebP, in pixels: the format's own limit.
pub const MAX_WEBP_PX: u32 = 16_383;

/// Largest number of pixels of a WebP, whose writer takes about ten bytes for each.
pub const MAX_WEBP_PIXELS: u64 = 1 << 26;

/// Why an export failed.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A side is zero or above [`MAX_PICTURE_PX`].
    #[error("a picture of {}x{} pixels: both sides must be from 1 to {MAX_PICTURE_PX}", .0[0], .0[1])]
    Size([u32; 2]),
    /// Both eyes' pictures in one file have a side above [`MAX_PICTURE_PX`].
    #[error("both eyes' pictures of {}x{} pixels make a file of {}x{}, and the limit is {MAX_PICTURE_PX}: choose a smaller size or a pair of files", .picture_px[0], .picture_px[1], .sheet_px[0], .sheet_px[1])]
    Sheet {
        /// Width and height of one eye's picture.
        picture_px: [u32; 2],
        /// Width and height of both pictures together.
        sheet_px: [u32; 2],
    },
    /// A WebP with a side above [`MAX_WEBP_PX`], or more than [`MAX_WEBP_PIXELS`] pixels.
    #[error("a WebP of {}x{} pixels: both sides must be from 1 to {MAX_WEBP_PX}, and their product at most {MAX_WEBP_PIXELS}; choose a smaller size, PNG or JPEG", .0[0], .0[1])]
    WebPSize([u32; 2]),
    /// 16 bits per channel of another format than PNG.
    #[error(
        "only a PNG can have 16 bits per channel: choose PNG, or 8 bits (an OpenEXR file always has 32)"
    )]
    Deep,
    /// A transparent background of a format without alpha.
    #[error(
        "a JPEG cannot have a transparent background: choose PNG, WebP or OpenEXR, or keep the background"
    )]
    Transparent,
    /// A transparent background of an anaglyph, whose colours are of two eyes.
    #[error(
        "a red-cyan anaglyph mixes both eyes' pictures, so its background cannot be transparent: choose side by side, top-bottom or a pair"
    )]
    TransparentRedCyan,
    /// An OpenEXR file's channels cannot store the radiance of both eyes.
    #[error(
        "a red-cyan anaglyph mixes both eyes' pictures, so it cannot be an OpenEXR file: choose another format, side by side, top-bottom or a pair"
    )]
    RedCyanExr,
    /// The scene or the requested samples are out of range.
    #[error(transparent)]
    Scene(#[from] Invalid),
    /// The path has no keys, or none of the requested frames.
    #[error("the camera path has no such frames")]
    NoFrames,
    /// Writing to the sink failed.
    #[error("the picture could not be written: {0}")]
    Write(#[from] std::io::Error),
    /// The encoder rejected the input.
    #[error("the encoder failed: {0}")]
    Encode(String),
    /// The device was lost or reported an error.
    #[error("the GPU failed: {0}")]
    Gpu(String),
    /// The caller cancelled the job.
    #[error("cancelled")]
    Cancelled,
}

/// Returns `size_px` if both sides are from 1 to [`MAX_PICTURE_PX`].
///
/// # Errors
/// [`ExportError::Size`] otherwise.
pub fn checked_size(size_px: [u32; 2]) -> Result<[u32; 2], ExportError> {
    if size_px.iter().all(|side| (1..=MAX_PICTURE_PX).contains(side)) {
        Ok(size_px)
    } else {
        Err(ExportError::Size(size_px))
    }
}

/// Returns `size_px` if a WebP can have it.
///
/// # Errors
/// [`ExportError::WebPSize`] otherwise.
pub fn checked_webp_size(size_px: [u32; 2]) -> Result<[u32; 2], ExportError> {
    let pixels: u64 = size_px.iter().map(|&side| u64::from(side)).product();
    let fits = size_px.iter().all(|side| (1..=MAX_WEBP_PX).contains(side));
    if fits && pixels <= MAX_WEBP_PIXELS {
        Ok(size_px)
    } else {
        Err(ExportError::WebPSize(size_px))
    }
}
