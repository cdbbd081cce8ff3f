//! A picture's light as a few lights from directions, by median cut (Debevec 2005, "A Median Cut
//! Algorithm for Light Probe Sampling"), for any number of them.
//!
//! The paper divides every region again and again, which gives powers of two. Here the region
//! with the most light is divided until there are as many as are wanted. Each cut runs across a
//! region's longer side, with equal luminance on both sides, every pixel weighted with its solid
//! angle; a region's light goes to the centre of its light. Regions as small as
//! [`SMALLEST_DEG`] are divided last of all: several lights on one sun would cast the same
//! shadow.

use std::{
    f64::consts::{PI, TAU},
    ops::Range,
};

use glam::{DVec2, DVec3};

use super::EnvironmentMap;
use crate::scene::color::luminance;

/// A region whose sides are no longer than this is small enough for one shadow, degrees.
pub const SMALLEST_DEG: f64 = 2.0;

/// A part of the picture's light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutLight {
    /// Unit vector toward the centre of its light.
    pub direction: DVec3,
    /// Radiance times solid angle, linear Rec. 709, summed over its region.
    pub energy: DVec3,
}

/// `count` lights, or fewer where there are not as many pixels that shine, which together carry
/// the picture's light; in no particular order.
pub fn median_cut(environment_map: &EnvironmentMap, count: usize) -> Vec<CutLight> {
    let table = Table::new(environment_map);
    let [width, height] = environment_map.size_px();
    let mut regions = vec![Region::new(&table, 0..width, 0..height)];
    while regions.len() < count {
        let by_rank = |a: &Region, b: &Region| {
            a.is_large.cmp(&b.is_large).then(a.luminance.total_cmp(&b.luminance))
        };
        let divisible = regions.iter().enumerate().filter(|(_, region)| region.is_divisible());
        let Some((most, _)) = divisible.max_by(|(_, a), (_, b)| by_rank(a, b)) else { break };
        let (first, second) = regions.swap_remove(most).divided(&table);
        regions.extend([first, second]);
    }
    regions.iter().take(count).filter_map(|region| region.light(environment_map, &table)).collect()
}

/// What is asked for again and again.
struct Table {
    /// Sums of luminance times solid angle over every rectangle from the upper left corner.
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
            let mut of_row = 0.0;
            sums.push(0.0);
            for pixel in row {
                of_row += luminance(pixel.as_dvec3()) * solid_angle;
                let above = sums[sums.len() - stride];
                sums.push(above + of_row);
            }
        }
        let width = f64::from(size_px[0]);
        let azimuth = |x: u32| ((f64::from(x) + 0.5) / width - 0.5) * TAU;
        let columns = (0..size_px[0]).map(|x| DVec2::from(azimuth(x).sin_cos())).collect();
        Self { sums, columns, size_px }
    }

    /// The sum over a rectangle.
    fn over(&self, x: &Range<u32>, y: &Range<u32>) -> f64 {
        let at =
            |x: u32, y: u32| self.sums[y as usize * (self.size_px[0] as usize + 1) + x as usize];
        at(x.end, y.end) - at(x.start, y.end) - at(x.end, y.start) + at(x.start, y.start)
    }
}

/// A rectangle of the picture.
struct Region {
    x: Range<u32>,
    y: Range<u32>,
    luminance: f64,
    /// Its longer side is one across.
    is_wide: bool,
    /// Worth more than one light.
    is_large: bool,
}

impl Region {
    fn new(table: &Table, x: Range<u32>, y: Range<u32>) -> Self {
        let [width, height] = table.size_px.map(f64::from);
        let pixels = |range: &Range<u32>| f64::from(range.end - range.start);
        // Across, the mean of its rows.
        let polar_rad = |y: u32| f64::from(y) / height * PI;
        let (top_rad, bottom_rad) = (polar_rad(y.start), polar_rad(y.end));
        let mean_sine = (top_rad.cos() - bottom_rad.cos()) / (bottom_rad - top_rad);
        let across_rad = pixels(&x) / width * TAU * mean_sine;
        let down_rad = bottom_rad - top_rad;
        Self {
            luminance: table.over(&x, &y),
            is_wide: pixels(&y) < 2.0 || (pixels(&x) > 1.0 && across_rad > down_rad),
            is_large: across_rad.max(down_rad) > SMALLEST_DEG.to_radians(),
            x,
            y,
        }
    }

    fn is_divisible(&self) -> bool {
        self.luminance > 0.0 && (self.x.end - self.x.start > 1 || self.y.end - self.y.start > 1)
    }

    /// Its two halves: as near to half of the luminance each as whole pixels allow.
    fn divided(self, table: &Table) -> (Self, Self) {
        let Self { x, y, luminance, is_wide, .. } = self;
        let side = if is_wide { x.clone() } else { y.clone() };
        let before = |cut: u32| {
            let part = side.start..cut;
            if is_wide { table.over(&part, &y) } else { table.over(&x, &part) }
        };
        // Both halves keep a pixel.
        let (mut low, mut high) = (side.start + 1, side.end - 1);
        while low < high {
            let middle = low + (high - low) / 2;
            if before(middle) < luminance / 2.0 {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        // The first cut past the half, or the one ahead of it.
        let off = |cut: u32| (before(cut) - luminance / 2.0).abs();
        let cut = if low > side.start + 1 && off(low - 1) < off(low) { low - 1 } else { low };
        let (first, second) = (side.start..cut, cut..side.end);
        if is_wide {
            (Self::new(table, first, y.clone()), Self::new(table, second, y))
        } else {
            (Self::new(table, x.clone(), first), Self::new(table, x, second))
        }
    }

    /// The region's light at its centre; none where it is black.
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
        // All around and evenly bright, light has no centre: up is as good as any direction.
        (energy != DVec3::ZERO)
            .then(|| CutLight { direction: toward.try_normalize().unwrap_or(DVec3::Z), energy })
    }
}
