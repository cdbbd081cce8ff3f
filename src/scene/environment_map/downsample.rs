//! Downsampling of a picture to a map of at most [`MAX_SIZE_PX`], pixel by pixel.
//!
//! Each target pixel is the mean of the source pixels that it covers, weighted by solid angle.
//! The sum of radiance times solid angle is preserved, and the source need not be in memory as a
//! whole.

use std::f64::consts::PI;

use glam::Vec3;

use super::map::{EnvironmentMap, MAX_SIZE_PX, clamp_radiance};

/// Accumulates source pixels into a map of at most [`MAX_SIZE_PX`].
pub struct Downsampler {
    source_px: [u32; 2],
    size_px: [u32; 2],
    /// Sums of pixels times their share of the target pixel's solid angle.
    means: Vec<Vec3>,
}

impl Downsampler {
    /// A downsampler for a source of `source_px`; a side of 0 counts as 1.
    pub fn new(source_px: [u32; 2]) -> Self {
        let source_px = source_px.map(|side| side.max(1));
        let size_px = std::array::from_fn(|i| source_px[i].min(MAX_SIZE_PX[i]));
        let means = vec![Vec3::ZERO; (size_px[0] * size_px[1]) as usize];
        Self { source_px, size_px, means }
    }

    /// Adds source pixels of a row, from `x` on; ignores positions outside the source.
    ///
    /// Channels are clamped to 0 to [`super::MAX_RADIANCE`]; NaN counts as 0.
    pub fn add_row(&mut self, [x, y]: [u32; 2], pixels: impl IntoIterator<Item = Vec3>) {
        if y >= self.source_px[1] {
            return;
        }
        let [width, height] = self.size_px;
        let source_height = f64::from(self.source_px[1]);
        // The source row's share of each target row's solid angle: exactly 1 where the two are the same row.
        let rows = Overlaps::of(y, self.source_px[1], height).map(|(row, top, bottom)| {
            let polar = |part: f64| ((f64::from(y) + part) / source_height * PI).cos();
            let target = |row: u32| (f64::from(row) / f64::from(height) * PI).cos();
            (row, (polar(top) - polar(bottom)) / (target(row) - target(row + 1)))
        });
        let rows: Vec<(u32, f64)> = rows.collect();
        // The width of a target pixel in source pixels.
        let pixel_width = f64::from(self.source_px[0]) / f64::from(width);
        for (x, pixel) in (x..self.source_px[0]).zip(pixels) {
            let pixel = clamp_radiance(pixel);
            for (column, left, right) in Overlaps::of(x, self.source_px[0], width) {
                let share = (right - left) / pixel_width;
                for (row, weight) in &rows {
                    self.means[(row * width + column) as usize] += pixel * (weight * share) as f32;
                }
            }
        }
    }

    /// The map of the added pixels; pixels that were not added are black.
    pub fn finish(self, name: &str) -> EnvironmentMap {
        let Self { size_px, means: mut pixels, .. } = self;
        // Rounding may exceed the range.
        pixels.iter_mut().for_each(|pixel| *pixel = clamp_radiance(*pixel));
        EnvironmentMap::new(name, size_px, pixels)
    }
}

/// The target pixels that a source pixel overlaps, along one axis.
///
/// Each item is the target's index and the overlap's start and end, as fractions of the source
/// pixel.
struct Overlaps {
    index: u32,
    source: u64,
    target: u64,
    next: u64,
}

impl Overlaps {
    fn of(index: u32, source: u32, target: u32) -> Self {
        let (source, target) = (u64::from(source), u64::from(target));
        Self { index, source, target, next: u64::from(index) * target / source }
    }
}

impl Iterator for Overlaps {
    type Item = (u32, f64, f64);

    fn next(&mut self) -> Option<Self::Item> {
        // Integers in units of 1 / (source · target), so that edges meet exactly.
        let begin = u64::from(self.index) * self.target;
        let end = begin + self.target;
        let (low, high) = (self.next * self.source, (self.next + 1) * self.source);
        if low >= end {
            return None;
        }
        let part = |at: u64| (at.clamp(begin, end) - begin) as f64 / self.target as f64;
        let overlap = (self.next as u32, part(low), part(high));
        self.next += 1;
        Some(overlap)
    }
}
