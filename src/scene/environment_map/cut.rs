//! Median cut: an environment map as a few directional lights (Debevec 2005, "A Median Cut
//! Algorithm for Light Probe Sampling").
//!
//! The paper divides every region in each round, which gives a power of two. Here each step
//! divides the region with the most light, so any number of lights is possible. A cut runs across
//! the region's longer side and leaves equal luminance on both sides; each pixel is weighted by
//! its solid angle. The light of a region points to the region's luminance centroid. Regions up
//! to [`SMALLEST_DEG`] are divided last: several lights on one sun cast the same shadow.

use std::{
    f64::consts::{PI, TAU},
    ops::Range,
};

use glam::{DVec2, DVec3};

use super::map::EnvironmentMap;
use crate::scene::color::luminance;

/// Longest side of a region that one shadow represents well enough, degrees.
pub const SMALLEST_DEG: f64 = 2.0;

/// A directional light that carries the light of one region of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutLight {
    /// Unit vector toward the region's luminance centroid.
    pub direction: DVec3,
    /// Radiance times solid angle, linear Rec. 709, summed over the region.
    pub energy: DVec3,
}

impl EnvironmentMap {
    /// At most `count` lights that together carry the map's light; see [`median_cut`].
    pub fn cut(&self, count: usize) -> Vec<CutLight> {
        median_cut(self, count)
    }
}

/// At most `count` lights that together carry the map's light, in no particular order.
///
/// A map with fewer bright pixels than `count` gives fewer lights.
pub fn median_cut(environment_map: &EnvironmentMap, count: usize) -> Vec<CutLight> {
    let table = Table::new(environment_map);
    let [width, height] = environment_map.size_px();
    let mut regions = vec![Region::new(&table, 0..width, 0..height)];
    while regions.len() < count {
        let by_priority = |a: &Region, b: &Region| {
            a.is_large.cmp(&b.is_large).then(a.luminance.total_cmp(&b.luminance))
        };
        let divisible = regions.iter().enumerate().filter(|(_, region)| region.is_divisible());
        let Some((next, _)) = divisible.max_by(|(_, a), (_, b)| by_priority(a, b)) else { break };
        let (first, second) = regions.swap_remove(next).divided(&table);
        regions.extend([first, second]);
    }
    regions.iter().take(count).filter_map(|region| region.light(environment_map, &table)).collect()
}

/// Tables of the map that every cut reads.
struct Table {
    /// Summed-area table of luminance times solid angle.
    sums: Vec<f64>,
    /// The horizontal unit vector toward each column.
    columns: Vec<DVec2>,
    size_px: [u32; 2],
}

impl Table {
    fn new(environment_map: &EnvironmentMap) -> Self {
        let size_px = environment_map.size_px();
        let stride = size_px[0] as usize + 1;
        let mut sums = vec![0.0; stride];
        let rows = environment_map.pixels().chunks_exact(size_px[0] as usize);
        for (y, row) in (0..).zip(rows) {
            let solid_angle = environment_map.pixel_solid_angle(y);
            let mut row_sum = 0.0;
            sums.push(0.0);
            for pixel in row {
                row_sum += luminance(pixel.as_dvec3()) * solid_angle;
                let above = sums[sums.len() - stride];
                sums.push(above + row_sum);
            }
        }
        let width = f64::from(size_px[0]);
        let azimuth = |x: u32| ((f64::from(x) + 0.5) / width - 0.5) * TAU;
        let columns = (0..size_px[0]).map(|x| DVec2::from(azimuth(x).sin_cos())).collect();
        Self { sums, columns, size_px }
    }

    /// Luminance times solid angle, summed over a rectangle.
    fn sum_over(&self, x: &Range<u32>, y: &Range<u32>) -> f64 {
        let at =
            |x: u32, y: u32| self.sums[y as usize * (self.size_px[0] as usize + 1) + x as usize];
        at(x.end, y.end) - at(x.start, y.end) - at(x.end, y.start) + at(x.start, y.start)
    }
}

/// A rectangle of the map's pixels.
struct Region {
    x: Range<u32>,
    y: Range<u32>,
    luminance: f64,
    /// True if the horizontal side is the longer one.
    is_wide: bool,
    /// True if the longer side exceeds [`SMALLEST_DEG`].
    is_large: bool,
}

impl Region {
    fn new(table: &Table, x: Range<u32>, y: Range<u32>) -> Self {
        let [width, height] = table.size_px.map(f64::from);
        let pixels = |range: &Range<u32>| f64::from(range.end - range.start);
        // The width in radians is the mean over the region's rows.
        let polar_rad = |y: u32| f64::from(y) / height * PI;
        let (top_rad, bottom_rad) = (polar_rad(y.start), polar_rad(y.end));
        let mean_sine = (top_rad.cos() - bottom_rad.cos()) / (bottom_rad - top_rad);
        let across_rad = pixels(&x) / width * TAU * mean_sine;
        let down_rad = bottom_rad - top_rad;
        Self {
            luminance: table.sum_over(&x, &y),
            is_wide: pixels(&y) < 2.0 || (pixels(&x) > 1.0 && across_rad > down_rad),
            is_large: across_rad.max(down_rad) > SMALLEST_DEG.to_radians(),
            x,
            y,
        }
    }

    fn is_divisible(&self) -> bool {
        self.luminance > 0.0 && (self.x.end - self.x.start > 1 || self.y.end - self.y.start > 1)
    }

    /// Two halves of the region, with luminances as equal as whole pixels allow.
    fn divided(self, table: &Table) -> (Self, Self) {
        let Self { x, y, luminance, is_wide, .. } = self;
        let side = if is_wide { x.clone() } else { y.clone() };
        let before = |cut: u32| {
            let part = side.start..cut;
            if is_wide { table.sum_over(&part, &y) } else { table.sum_over(&x, &part) }
        };
        // Each half has at least one row or column.
        let (mut low, mut high) = (side.start + 1, side.end - 1);
        while low < high {
            let middle = low + (high - low) / 2;
            if before(middle) < luminance / 2.0 {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        // `low` is the first cut past half the luminance; the cut before it may be nearer.
        let error = |cut: u32| (before(cut) - luminance / 2.0).abs();
        let cut = if low > side.start + 1 && error(low - 1) < error(low) { low - 1 } else { low };
        let (first, second) = (side.start..cut, cut..side.end);
        if is_wide {
            (Self::new(table, first, y.clone()), Self::new(table, second, y))
        } else {
            (Self::new(table, x.clone(), first), Self::new(table, x, second))
        }
    }

    /// The region's light, toward its luminance centroid; none for a black region.
    fn light(&self, environment_map: &EnvironmentMap, table: &Table) -> Option<CutLight> {
        let [width, height] = environment_map.size_px();
        let (mut energy, mut toward) = (DVec3::ZERO, DVec3::ZERO);
        for y in self.y.clone() {
            let solid_angle = environment_map.pixel_solid_angle(y);
            let (sin, cos) = ((f64::from(y) + 0.5) / f64::from(height) * PI).sin_cos();
            for x in self.x.clone() {
                let pixel =
                    environment_map.pixels()[(y * width + x) as usize].as_dvec3() * solid_angle;
                energy += pixel;
                toward += (table.columns[x as usize] * sin).extend(cos) * luminance(pixel);
            }
        }
        // Light that is equal from all sides has no centroid; +z is then an arbitrary choice.
        (energy != DVec3::ZERO)
            .then(|| CutLight { direction: toward.try_normalize().unwrap_or(DVec3::Z), energy })
    }
}
