//! An equirectangular environment map: linear radiance from every direction.
//!
//! In: rows of pixels, or the bytes of a file ([`decode()`]). Out: the map's pixels, and a few
//! directional lights that approximate the map ([`cut`]). A map has at most [`MAX_SIZE_PX`]
//! pixels; [`Downsampler`] shrinks larger files while they are read and keeps their total light.
//!
//! The upper edge is +z, the centre is +y, and +x is to the right of the centre: the map as seen
//! from inside the sphere.
//!
//! | file | contents |
//! |---|---|
//! | `map` | [`EnvironmentMap`]: its pixels and their light |
//! | `projection` | directions, and their positions in a map |
//! | `downsample` | a map from a larger picture's pixels |
//! | [`mod@decode`] | a map from a file's bytes |
//! | [`cut`] | a map's lights |

pub mod cut;
pub mod decode;
mod downsample;
mod map;
mod projection;

pub use cut::CutLight;
pub use decode::{DecodeError, decode, is_environment_map};
pub use downsample::Downsampler;
pub use map::{EnvironmentMap, MAX_NAME_CHARS, MAX_RADIANCE, MAX_SIZE_PX};
pub use projection::{Uv, direction_from_uv, uv_from_direction};

#[cfg(test)]
mod tests;
