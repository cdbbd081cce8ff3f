//! Why a file cannot be decoded, and the limits of its size.

use crate::reading::source::Unreadable;

/// Largest width and height of a file, in pixels.
pub const MAX_SOURCE_PX: [u32; 2] = [8192, 8192];
/// Largest number of pixels in a file.
pub const MAX_SOURCE_PIXELS: u64 = 8192 * 4096;
/// Largest file size, in bytes.
pub const MAX_FILE_BYTES: usize = 256 << 20;

/// Why a file cannot be decoded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// Larger than [`MAX_FILE_BYTES`].
    #[error(
        "the file is larger than {} MiB: save it compressed, or with fewer pixels",
        MAX_FILE_BYTES >> 20
    )]
    TooLarge,
    /// Neither format's signature.
    #[error("neither a Radiance picture (.hdr) nor an OpenEXR picture (.exr)")]
    Format,
    /// Width and height in pixels: 0, or above the limits.
    #[error(
        "the picture has {}x{} pixels; the limits are 1x1 to {}x{}, and {MAX_SOURCE_PIXELS} pixels in all",
        .0[0], .0[1], MAX_SOURCE_PX[0], MAX_SOURCE_PX[1]
    )]
    Size([u64; 2]),
    /// Truncated, damaged, or an unsupported variant of the format.
    #[error("the picture cannot be read: {0}")]
    Unreadable(#[from] Unreadable),
}

/// The error of this message, which may quote the file at any length.
pub(super) fn unreadable(message: impl std::fmt::Display) -> DecodeError {
    Unreadable::new(message).into()
}

/// The size as it is, within the limits.
pub(super) fn checked_size(size: [u64; 2]) -> Result<[u32; 2], DecodeError> {
    let fits = (0..2).all(|i| (1..=u64::from(MAX_SOURCE_PX[i])).contains(&size[i]))
        && size[0] * size[1] <= MAX_SOURCE_PIXELS;
    // The limits are within u32.
    if fits { Ok(size.map(|side| side as u32)) } else { Err(DecodeError::Size(size)) }
}
