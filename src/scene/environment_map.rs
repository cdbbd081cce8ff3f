//! An equirectangular environment map: linear radiance from every direction.
//!
//! In: rows of pixels, or the bytes of a file ([`decode`]). Out: the radiance from a direction,
//! and the lights that stand for all of it ([`cut`]). A picture keeps at most
//! [`MAX_SIZE_PX`] pixels: larger ones are brought down as they come in, so that none of their
//! light is lost.
//!
//! Its upper edge is +z and its middle +y; x grows to the right of the middle, as the
//! surroundings are seen from inside.

pub mod cut;
pub mod decode;
mod gather;

use std::{
    f64::consts::{PI, TAU},
    sync::atomic::{AtomicU64, Ordering},
};

use glam::{DVec3, Vec3};

use super::MAX_NAME_CHARS;

pub use cut::CutLight;
pub use decode::{DecodeError, decode, is_environment_map};
pub use gather::Gather;

/// Most pixels that are kept, across and down.
pub const MAX_SIZE_PX: [u32; 2] = [2048, 1024];

/// The largest value of a pixel's channel that is kept: that of the shared-exponent format in
/// which the GPU holds it.
pub const MAX_RADIANCE: f32 = 65_408.0;

/// A picture of all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    name: String,
    size_px: [u32; 2],
    /// Rows from the top, linear Rec. 709, each channel 0 to [`MAX_RADIANCE`].
    pixels: Vec<Vec3>,
    id: u64,
}

/// Where something lies in a picture: 0 to 1 from its left and its upper edge.
pub type Place = [f64; 2];

impl EnvironmentMap {
    /// A picture of its mean colour in each direction, as `radiance` gives it for pixel centres.
    pub fn from_fn(
        name: &str,
        size_px: [u32; 2],
        mut radiance: impl FnMut(DVec3) -> DVec3,
    ) -> Self {
        let size_px = std::array::from_fn(|i| size_px[i].clamp(1, MAX_SIZE_PX[i]));
        let [width, height] = size_px;
        let pixels = (0..height)
            .flat_map(|y| (0..width).map(move |x| [x, y]))
            .map(|[x, y]| {
                let place = [
                    (f64::from(x) + 0.5) / f64::from(width),
                    (f64::from(y) + 0.5) / f64::from(height),
                ];
                clean(radiance(direction_at(place)).as_vec3())
            })
            .collect();
        Self::new(name, size_px, pixels)
    }

    fn new(name: &str, size_px: [u32; 2], pixels: Vec<Vec3>) -> Self {
        static NEXT_ID: AtomicU64 = AtomicU64::new(1);
        // Scenes name their picture, and a scene's names have an end.
        let name = name.chars().take(MAX_NAME_CHARS).collect();
        Self { name, size_px, pixels, id: NEXT_ID.fetch_add(1, Ordering::Relaxed) }
    }

    /// The name of the file that it came from, at most [`MAX_NAME_CHARS`] characters of it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A number that no other picture of this process has.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Width and height in pixels, at most [`MAX_SIZE_PX`].
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// The pixels, rows from the top: linear Rec. 709, each channel 0 to [`MAX_RADIANCE`].
    pub fn pixels(&self) -> &[Vec3] {
        &self.pixels
    }

    /// The solid angle of each pixel of row `y`, in steradians.
    pub fn pixel_solid_angle(&self, y: u32) -> f64 {
        let [width, height] = self.size_px.map(f64::from);
        let polar = |y: f64| (y / height * PI).cos();
        (polar(y.into()) - polar(f64::from(y) + 1.0)) * TAU / width
    }

    /// Radiance times solid angle, summed over the picture.
    pub fn energy(&self) -> DVec3 {
        let width = self.size_px[0] as usize;
        (0..).zip(self.pixels.chunks_exact(width)).fold(DVec3::ZERO, |sum, (y, row)| {
            let of_row: DVec3 = row.iter().map(|pixel| pixel.as_dvec3()).sum();
            sum + of_row * self.pixel_solid_angle(y)
        })
    }

    /// The `count` lights that stand for the picture, or fewer; see [`cut`].
    pub fn cut(&self, count: usize) -> Vec<CutLight> {
        cut::median_cut(self, count)
    }
}

/// A channel that can be reckoned with: what is no number or below zero counts as black.
fn clean(pixel: Vec3) -> Vec3 {
    let kept = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(0.0, MAX_RADIANCE) };
    Vec3::from_array(pixel.to_array().map(kept))
}

/// The unit vector toward a place of the picture.
pub fn direction_at([u, v]: Place) -> DVec3 {
    let (sin_azimuth, cos_azimuth) = ((u - 0.5) * TAU).sin_cos();
    let (sin_polar, cos_polar) = (v * PI).sin_cos();
    DVec3::new(sin_polar * sin_azimuth, sin_polar * cos_azimuth, cos_polar)
}

/// The place of the picture that `direction`, of any length but 0, points at.
pub fn place_of(direction: DVec3) -> Place {
    let azimuth = direction.x.atan2(direction.y);
    let polar = direction.truncate().length().atan2(direction.z);
    [azimuth / TAU + 0.5, polar / PI]
}

#[cfg(test)]
mod tests;
