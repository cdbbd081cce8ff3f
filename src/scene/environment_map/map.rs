//! The map's pixels, and their light.

use std::{
    f64::consts::{PI, TAU},
    sync::atomic::{AtomicU64, Ordering},
};

use glam::{DVec3, Vec3};

use super::projection::direction_from_uv;

/// Largest size of a map, width and height in pixels.
pub const MAX_SIZE_PX: [u32; 2] = [2048, 1024];

/// Largest value of a channel: the limit of the GPU's shared-exponent texture format.
pub const MAX_RADIANCE: f32 = 65_408.0;

/// Maximum length of a map's name, in characters.
pub const MAX_NAME_CHARS: usize = 200;

/// An equirectangular map of linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentMap {
    name: String,
    size_px: [u32; 2],
    /// Rows from the top, linear Rec. 709, each channel 0 to [`MAX_RADIANCE`].
    pixels: Vec<Vec3>,
    id: u64,
}

impl EnvironmentMap {
    /// A map whose pixels are `radiance` of the directions to the pixel centres.
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
                let uv = [
                    (f64::from(x) + 0.5) / f64::from(width),
                    (f64::from(y) + 0.5) / f64::from(height),
                ];
                clamp_radiance(radiance(direction_from_uv(uv)).as_vec3())
            })
            .collect();
        Self::new(name, size_px, pixels)
    }

    /// Whether a map may be as large.
    pub fn has_size(size_px: [u32; 2]) -> bool {
        (0..2).all(|i| (1..=MAX_SIZE_PX[i]).contains(&size_px[i]))
    }

    /// A map of these pixels, clamped; none if their number is not that of a size up to [`MAX_SIZE_PX`].
    pub fn from_pixels(name: &str, size_px: [u32; 2], mut pixels: Vec<Vec3>) -> Option<Self> {
        if !Self::has_size(size_px)
            || pixels.len() as u64 != u64::from(size_px[0]) * u64::from(size_px[1])
        {
            return None;
        }
        for pixel in &mut pixels {
            *pixel = clamp_radiance(*pixel);
        }
        Some(Self::new(name, size_px, pixels))
    }

    pub(super) fn new(name: &str, size_px: [u32; 2], pixels: Vec<Vec3>) -> Self {
        static NEXT_ID: AtomicU64 = AtomicU64::new(1);
        // A scene stores the map's name, and a document limits names to this length.
        let name = name.chars().take(MAX_NAME_CHARS).collect();
        Self { name, size_px, pixels, id: NEXT_ID.fetch_add(1, Ordering::Relaxed) }
    }

    /// The file's name, cut to [`MAX_NAME_CHARS`] characters.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// An identifier, unique among this process's maps.
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

    /// Radiance times solid angle, summed over the map.
    pub fn energy(&self) -> DVec3 {
        let width = self.size_px[0] as usize;
        (0..).zip(self.pixels.chunks_exact(width)).fold(DVec3::ZERO, |sum, (y, row)| {
            let row_sum: DVec3 = row.iter().map(|pixel| pixel.as_dvec3()).sum();
            sum + row_sum * self.pixel_solid_angle(y)
        })
    }
}

/// Clamps each channel to 0 to [`MAX_RADIANCE`]; NaN becomes 0.
pub(super) fn clamp_radiance(pixel: Vec3) -> Vec3 {
    let clamped = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(0.0, MAX_RADIANCE) };
    Vec3::from_array(pixel.to_array().map(clamped))
}
