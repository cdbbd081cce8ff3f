//! An environment map out of a file: Radiance RGBE (`.hdr`) or OpenEXR (`.exr`).
//!
//! In: bytes that may come from anyone. Out: a picture of which every channel is finite, not
//! negative and within the GPU's range, or an error that says what is wrong with the file.

use std::io::Cursor;

use exr::prelude as exr;
use glam::Vec3;
use image::{ImageDecoder as _, codecs::hdr::HdrDecoder};

use super::{EnvironmentMap, Gather};

/// Most pixels that a file may have, across and down.
pub const MAX_SOURCE_PX: [u32; 2] = [8192, 8192];
/// Most pixels that a file may have in all.
pub const MAX_SOURCE_PIXELS: u64 = 8192 * 4096;
/// The largest file that is read, in bytes.
pub const MAX_FILE_BYTES: usize = 512 << 20;

const RADIANCE_SIGNATURE: &[u8] = b"#?";
const EXR_SIGNATURE: &[u8] = &[0x76, 0x2f, 0x31, 0x01];

/// Why a file gives no environment map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DecodeError {
    /// Larger than [`MAX_FILE_BYTES`].
    #[error("the file has more than {} MiB", MAX_FILE_BYTES >> 20)]
    TooLarge,
    /// Neither format's signature.
    #[error("neither a Radiance picture (.hdr) nor an OpenEXR picture (.exr)")]
    Format,
    /// A size that is not read.
    #[error(
        "the picture has {}x{} pixels; at most {}x{} and {MAX_SOURCE_PIXELS} in all are read, and none without any",
        .0[0], .0[1], MAX_SOURCE_PX[0], MAX_SOURCE_PX[1]
    )]
    Size([u64; 2]),
    /// Cut short, damaged, or of a kind that is not read.
    #[error("the picture cannot be read: {0}")]
    Unreadable(String),
}

/// Whether `bytes` begin like a file that [`decode`] reads.
pub fn is_environment_map(bytes: &[u8]) -> bool {
    bytes.starts_with(RADIANCE_SIGNATURE) || bytes.starts_with(EXR_SIGNATURE)
}

/// Reads a picture; `name` is what it is called from then on.
///
/// Of an OpenEXR file it takes the first layer with channels R, G and B. The pixels are taken as
/// linear Rec. 709.
///
/// # Errors
/// See [`DecodeError`].
pub fn decode(name: &str, bytes: &[u8]) -> Result<EnvironmentMap, DecodeError> {
    if bytes.len() > MAX_FILE_BYTES {
        return Err(DecodeError::TooLarge);
    }
    let gather = if bytes.starts_with(RADIANCE_SIGNATURE) {
        radiance(bytes)?
    } else if bytes.starts_with(EXR_SIGNATURE) {
        openexr(bytes)?
    } else {
        return Err(DecodeError::Format);
    };
    Ok(gather.finish(name))
}

fn unreadable(error: impl std::fmt::Display) -> DecodeError {
    // An error can quote the file, which can hold anything.
    DecodeError::Unreadable(error.to_string().chars().take(200).collect())
}

fn checked_size(size: [u64; 2]) -> Result<[u32; 2], DecodeError> {
    let fits = (0..2).all(|i| (1..=u64::from(MAX_SOURCE_PX[i])).contains(&size[i]))
        && size[0] * size[1] <= MAX_SOURCE_PIXELS;
    // Within the limits, hence within u32.
    if fits { Ok(size.map(|side| side as u32)) } else { Err(DecodeError::Size(size)) }
}

fn radiance(bytes: &[u8]) -> Result<Gather, DecodeError> {
    // Not strictly: pictures that say "#?RGBE" are read too.
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(unreadable)?;
    let (width, height) = decoder.dimensions();
    let [width, height] = checked_size([width.into(), height.into()])?;
    // Some programs scale what they store, and say by how much.
    let exposure = decoder.metadata().exposure.unwrap_or(1.0);
    if !(exposure.is_normal() && exposure > 0.0) {
        return Err(unreadable(format!("EXPOSURE={exposure}")));
    }
    let mut pixels = vec![0.0_f32; 3 * width as usize * height as usize];
    decoder.read_image(bytemuck::cast_slice_mut(&mut pixels)).map_err(unreadable)?;
    let mut gather = Gather::new([width, height]);
    for (y, row) in (0..height).zip(pixels.chunks_exact(3 * width as usize)) {
        for (x, pixel) in (0..width).zip(row.chunks_exact(3)) {
            gather.add([x, y], Vec3::from_slice(pixel) / exposure);
        }
    }
    Ok(gather)
}

fn openexr(bytes: &[u8]) -> Result<Gather, DecodeError> {
    use exr::{ReadChannels as _, ReadLayers as _};
    // The sizes first: a reader makes room for what a header claims.
    let pedantic = false;
    let meta =
        exr::MetaData::read_from_buffered(Cursor::new(bytes), pedantic).map_err(unreadable)?;
    for header in &meta.headers {
        checked_size([header.layer_size.width() as u64, header.layer_size.height() as u64])?;
    }
    let size_of = |size: exr::Vec2<usize>| {
        // Checked above, for all layers.
        Gather::new([size.width() as u32, size.height() as u32])
    };
    let image = exr::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            move |size, _| size_of(size),
            |gather: &mut Gather, at, (r, g, b): (f32, f32, f32)| {
                gather.add([at.x() as u32, at.y() as u32], Vec3::new(r, g, b));
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(unreadable)?;
    Ok(image.layer_data.channel_data.pixels)
}
