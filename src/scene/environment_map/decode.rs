//! Decoding of environment maps: Radiance RGBE (`.hdr`) and OpenEXR (`.exr`) files.
//!
//! In: untrusted bytes. Out: a map whose channels are all finite and within 0 to
//! [`super::MAX_RADIANCE`], or an error that names the file's fault. Besides the map and the file's bytes, where
//! the caller keeps them, a row or a block of pixels is in memory.

mod error;
mod openexr;
mod radiance;

use std::io::{Cursor, Read, Seek};

use super::map::EnvironmentMap;
use crate::reading::{openexr::SIGNATURE as EXR_SIGNATURE, source::Source};
use error::unreadable;

#[cfg(test)]
mod tests;

pub use error::{DecodeError, MAX_FILE_BYTES, MAX_SOURCE_PIXELS, MAX_SOURCE_PX};
pub use openexr::{MAX_BLOCK_BYTES, MAX_BLOCKS, MAX_CHANNELS, MAX_PIXEL_BYTES, MIN_TILE_PX};
pub use radiance::MAX_HEADER_BYTES;

const RADIANCE_SIGNATURE: &[u8] = b"#?";

/// True if `bytes` begin with the signature of a format that [`decode`] reads.
pub fn is_environment_map(bytes: &[u8]) -> bool {
    bytes.starts_with(RADIANCE_SIGNATURE) || bytes.starts_with(&EXR_SIGNATURE)
}

/// Decodes a file's bytes to a map called `name`.
///
/// From an OpenEXR file, it reads the first part with channels R, G and B. The pixels count as
/// linear Rec. 709.
///
/// # Errors
/// See [`DecodeError`].
pub fn decode(name: &str, bytes: &[u8]) -> Result<EnvironmentMap, DecodeError> {
    decode_file(name, Cursor::new(bytes))
}

/// Decodes a file to a map called `name`, as [`decode`], without reading the whole file into memory.
///
/// # Errors
/// See [`DecodeError`].
pub fn decode_file(name: &str, file: impl Read + Seek) -> Result<EnvironmentMap, DecodeError> {
    let mut file = Source::new(file).map_err(unreadable)?;
    if file.length() > MAX_FILE_BYTES as u64 {
        return Err(DecodeError::TooLarge);
    }
    let mut start = [0; 4];
    // A shorter file has neither signature.
    let length = file.length().min(4) as usize;
    file.fill(&mut start[..length], "the signature")?;
    let downsampler = if start.starts_with(RADIANCE_SIGNATURE) {
        radiance::decode(&mut file)?
    } else if start.starts_with(&EXR_SIGNATURE) {
        openexr::decode(&mut file)?
    } else {
        return Err(DecodeError::Format);
    };
    Ok(downsampler.finish(name))
}
