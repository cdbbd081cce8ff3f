//! OpenEXR pictures, as "OpenEXR File Layout" describes them.
//!
//! Every size that a file declares is checked here, against the limits and the file's length, before
//! anything is allocated for it. The crate `exr` gets single blocks of known size, to decompress them.
//!
//! | file | contents |
//! |---|---|
//! | `header` | the parts of a file |
//! | `blocks` | the pixels of a part |

mod blocks;
mod header;

use std::io::{Read, Seek};

use super::error::DecodeError;
use crate::{reading::source::Source, scene::environment_map::downsample::Downsampler};

pub use blocks::{MAX_BLOCK_BYTES, MAX_BLOCKS, MAX_PIXEL_BYTES, MIN_TILE_PX};
pub use header::MAX_CHANNELS;

/// Reads the largest level of the first part with the channels R, G and B.
pub fn decode(file: &mut Source<impl Read + Seek>) -> Result<Downsampler, DecodeError> {
    let part = header::read(file)?;
    blocks::read(file, &part)
}
