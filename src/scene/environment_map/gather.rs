//! Rows of a picture of any size to one of at most [`MAX_SIZE_PX`], each as it comes.
//!
//! Every kept pixel is the mean of what it covers, weighted by solid angle: radiance times solid
//! angle, summed over the picture, stays what it was, and no more than one row of the large
//! picture need be there at a time.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};

use super::{EnvironmentMap, MAX_SIZE_PX, clean};

/// A picture that is coming in.
pub struct Gather {
    source_px: [u32; 2],
    size_px: [u32; 2],
    /// Sums of pixels times their solid angle, up to a factor that is the same for all.
    sums: Vec<DVec3>,
}

impl Gather {
    /// For a picture of `source_px`, both sides at least 1.
    pub fn new(source_px: [u32; 2]) -> Self {
        let source_px = source_px.map(|side| side.max(1));
        let size_px = std::array::from_fn(|i| source_px[i].min(MAX_SIZE_PX[i]));
        let sums = vec![DVec3::ZERO; (size_px[0] * size_px[1]) as usize];
        Self { source_px, size_px, sums }
    }

    /// Adds a pixel of the large picture; what lies outside of it is ignored. NaN, negative and
    /// too large values count as the nearest that can be kept.
    pub fn add(&mut self, [x, y]: [u32; 2], pixel: Vec3) {
        if x >= self.source_px[0] || y >= self.source_px[1] {
            return;
        }
        let pixel = clean(pixel).as_dvec3();
        let width = self.size_px[0];
        let height = f64::from(self.source_px[1]);
        let across = Cover::of(x, self.source_px[0], width);
        for (row, top, bottom) in Cover::of(y, self.source_px[1], self.size_px[1]) {
            let polar = |part: f64| ((f64::from(y) + part) / height * PI).cos();
            let weight = polar(top) - polar(bottom);
            for (column, left, right) in across.clone() {
                self.sums[(row * width + column) as usize] += pixel * (weight * (right - left));
            }
        }
    }

    /// The picture of what was added; what was not is black.
    pub fn finish(self, name: &str) -> EnvironmentMap {
        let [width, height] = self.size_px;
        // In units of the source's pixels across, as the sums are.
        let across = f64::from(self.source_px[0]) / f64::from(width);
        let polar = |y: usize| (y as f64 / f64::from(height) * PI).cos();
        let pixels = self
            .sums
            .chunks_exact(width as usize)
            .enumerate()
            .flat_map(|(y, row)| {
                let weight = across * (polar(y) - polar(y + 1));
                row.iter().map(move |sum| clean((*sum / weight).as_vec3()))
            })
            .collect();
        EnvironmentMap::new(name, self.size_px, pixels)
    }
}

/// The kept pixels that a source pixel lies on, each with the part of the source pixel, from
/// and to, that lies on it. Along one axis.
#[derive(Clone)]
struct Cover {
    index: u32,
    source: u64,
    kept: u64,
    next: u64,
}

impl Cover {
    fn of(index: u32, source: u32, kept: u32) -> Self {
        let (source, kept) = (u64::from(source), u64::from(kept));
        Self { index, source, kept, next: u64::from(index) * kept / source }
    }
}

impl Iterator for Cover {
    type Item = (u32, f64, f64);

    fn next(&mut self) -> Option<Self::Item> {
        // In units of 1 / (source · kept): whole numbers, so that edges meet.
        let begin = u64::from(self.index) * self.kept;
        let end = begin + self.kept;
        let (low, high) = (self.next * self.source, (self.next + 1) * self.source);
        if low >= end {
            return None;
        }
        let part = |at: u64| (at.clamp(begin, end) - begin) as f64 / self.kept as f64;
        let covered = (self.next as u32, part(low), part(high));
        self.next += 1;
        Some(covered)
    }
}
