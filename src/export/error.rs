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

impl ExportError {
    /// A file that could not be written, for a reason in the system's words.
    pub fn unwritten(reason: String) -> Self {
        Self::Write(std::io::Error::other(reason))
    }

    /// What happened and what to do, in plain words, with the detail at the end.
    pub fn explain(&self) -> String {
        let advice = match self {
            Self::Write(_) => {
                "The file could not be written. Check the free space on the disk, then save again."
            }
            Self::Encode(_) => {
                "The picture could not be made into a file. Choose another kind of file or a smaller size, then save again."
            }
            Self::Gpu(_) => {
                "The graphics card could not draw the picture. Close other programs that use it, or choose a smaller size, then save again."
            }
            Self::Cancelled => return "Saving was cancelled.".to_owned(),
            // Their sentences need no advice.
            _ => return format!("The file could not be saved: {self}."),
        };
        format!("{advice} ({self})")
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn explanations_begin_with_plain_words_and_end_with_the_detail() {
        let detail = "QuotaExceededError: 0x80070070";
        for error in [
            ExportError::Write(std::io::Error::other(detail)),
            ExportError::Encode(detail.to_owned()),
            ExportError::Gpu(detail.to_owned()),
        ] {
            let text = error.explain();
            assert!(text.starts_with("The "), "{text}");
            assert!(text.contains("save again. ("), "{text}");
            assert!(text.ends_with(&format!("{detail})")), "{text}");
        }
        let text = ExportError::WebPSize([20_000, 10]).explain();
        assert!(text.contains("choose a smaller size"), "{text}");
    }
}
