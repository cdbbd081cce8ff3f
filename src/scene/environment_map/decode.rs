//! Decoding of environment maps: Radiance RGBE (`.hdr`) and OpenEXR (`.exr`) files.
//!
//! In: untrusted bytes. Out: a map whose channels are all finite and within 0 to
//! [`super::MAX_RADIANCE`], or an error that names the file's fault.

use std::io::Cursor;

use exr::prelude as exr;
use glam::Vec3;
use image::{ImageDecoder as _, codecs::hdr::HdrDecoder};

use super::{downsample::Downsampler, map::EnvironmentMap};

/// Largest width and height of a file, in pixels.
pub const MAX_SOURCE_PX: [u32; 2] = [8192, 8192];
/// Largest number of pixels in a file.
pub const MAX_SOURCE_PIXELS: u64 = 8192 * 4096;
/// Largest file size, in bytes.
pub const MAX_FILE_BYTES: usize = 512 << 20;

const RADIANCE_SIGNATURE: &[u8] = b"#?";
const EXR_SIGNATURE: &[u8] = &[0x76, 0x2f, 0x31, 0x01];

/// Why a file cannot be decoded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// Larger than [`MAX_FILE_BYTES`].
    #[error("the file is larger than {} MiB", MAX_FILE_BYTES >> 20)]
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
    Unreadable(String),
}

/// True if `bytes` begin with the signature of a format that [`decode`] reads.
pub fn is_environment_map(bytes: &[u8]) -> bool {
    bytes.starts_with(RADIANCE_SIGNATURE) || bytes.starts_with(EXR_SIGNATURE)
}

/// Decodes a file's bytes to a map called `name`.
///
/// From an OpenEXR file, it reads the first layer with channels R, G and B. The pixels count as
/// linear Rec. 709.
///
/// # Errors
/// See [`DecodeError`].
pub fn decode(name: &str, bytes: &[u8]) -> Result<EnvironmentMap, DecodeError> {
    if bytes.len() > MAX_FILE_BYTES {
        return Err(DecodeError::TooLarge);
    }
    let downsampler = if bytes.starts_with(RADIANCE_SIGNATURE) {
        radiance(bytes)?
    } else if bytes.starts_with(EXR_SIGNATURE) {
        openexr(bytes)?
    } else {
        return Err(DecodeError::Format);
    };
    Ok(downsampler.finish(name))
}

fn unreadable(error: impl std::fmt::Display) -> DecodeError {
    // An error can quote the untrusted file at any length.
    DecodeError::Unreadable(error.to_string().chars().take(200).collect())
}

fn checked_size(size: [u64; 2]) -> Result<[u32; 2], DecodeError> {
    let fits = (0..2).all(|i| (1..=u64::from(MAX_SOURCE_PX[i])).contains(&size[i]))
        && size[0] * size[1] <= MAX_SOURCE_PIXELS;
    // The limits are within u32.
    if fits { Ok(size.map(|side| side as u32)) } else { Err(DecodeError::Size(size)) }
}

fn radiance(bytes: &[u8]) -> Result<Downsampler, DecodeError> {
    // The strict decoder rejects files with the signature "#?RGBE".
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    let [width, height] = checked_size([width.into(), height.into()])?;
    // EXPOSURE is the factor by which the writing program scaled the pixels.
    let exposure = decoder.metadata().exposure.unwrap_or(1.0);
    if !(exposure.is_normal() && exposure > 0.0) {
        return Err(unreadable(format!("EXPOSURE={exposure}")));
    }
    let mut pixels = vec![0.0_f32; 3 * width as usize * height as usize];
    decoder.read_image(bytemuck::cast_slice_mut(&mut pixels)).map_err(unreadable)?;
    let mut downsampler = Downsampler::new([width, height]);
    for (y, row) in (0..height).zip(pixels.chunks_exact(3 * width as usize)) {
        for (x, pixel) in (0..width).zip(row.chunks_exact(3)) {
            downsampler.add([x, y], Vec3::from_slice(pixel) / exposure);
        }
    }
    Ok(downsampler)
}

fn openexr(bytes: &[u8]) -> Result<Downsampler, DecodeError> {
    use exr::{ReadChannels as _, ReadLayers as _};
    // Sizes are checked first: the reader allocates the memory that a header claims.
    let pedantic = false;
    let meta =
        exr::MetaData::read_from_buffered(Cursor::new(bytes), pedantic).map_err(unreadable)?;
    for header in &meta.headers {
        checked_size([header.layer_size.width() as u64, header.layer_size.height() as u64])?;
    }
    let size_of = |size: exr::Vec2<usize>| {
        // All layers' sizes are checked above.
        Downsampler::new([size.width() as u32, size.height() as u32])
    };
    let image = exr::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            move |size, _| size_of(size),
            |downsampler: &mut Downsampler, at, (r, g, b): (f32, f32, f32)| {
                downsampler.add([at.x() as u32, at.y() as u32], Vec3::new(r, g, b));
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(unreadable)?;
    Ok(image.layer_data.channel_data.pixels)
}
