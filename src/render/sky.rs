//! The sky that light paths see: a map of radiance, and a table that selects directions by their energy.
//!
//! In: a rig's sky, or an environment map. Out: the map, and a table for the alias method (M. Vose, IEEE Trans.
//! Software Engineering 17(9), 1991), as texels for `shaders/lib/sky.wgsl`. The table's cells have equal solid angles:
//! columns of equal azimuth, rows of equal height.

use std::{f64::consts::PI, sync::Arc};

use crate::scene::{self, EnvironmentMap, RigKind, Scene, color::luminance};

/// Rows of a gradient's map; a row spans a small part of its haze.
const GRADIENT_ROWS: u32 = 1024;

/// Most columns and rows of the table.
const MAX_CELLS: [u32; 2] = [512, 512];

/// Part of the table's energy that is spread evenly: the map's filter carries light to cells beside bright ones.
const EVEN_PART: f64 = 0.02;

/// One cell of the table: the cell to take instead, the bits of the part that stays, the bits of the density.
type Cell = [u32; 4];

/// A sky with its table.
#[derive(Debug)]
pub struct SampledSky {
    map: Arc<EnvironmentMap>,
    size: [u32; 2],
    cells: Vec<Cell>,
    energy: f64,
}

impl PartialEq for SampledSky {
    /// Whether both are of the same map: a map's pixels never change.
    fn eq(&self, other: &Self) -> bool {
        self.map.id() == other.map.id()
    }
}

impl SampledSky {
    /// The sky of a map.
    pub fn of_map(map: &Arc<EnvironmentMap>) -> Self {
        let [columns, rows] = map.size_px();
        // A map of one column is the same on all sides.
        let size = [columns.min(MAX_CELLS[0]), (2 * rows).min(MAX_CELLS[1])];
        let energies = energies(map, size);
        let energy: f64 = energies.iter().sum();
        Self { map: map.clone(), size, cells: alias_table(&energies), energy }
    }

    /// The sky of a gradient, without its sun.
    pub fn of_gradient(sky: &scene::Sky) -> Self {
        let map = EnvironmentMap::from_fn("sky", [1, GRADIENT_ROWS], |d| sky.radiance(d));
        Self::of_map(&Arc::new(map))
    }

    /// The map of radiance.
    pub fn map(&self) -> &Arc<EnvironmentMap> {
        &self.map
    }

    /// Columns and rows of the table.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The table's texels, rows from the top.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Luminance integrated over all directions.
    pub fn energy(&self) -> f64 {
        self.energy
    }
}

/// Luminance times solid angle, for each cell.
fn energies(map: &EnvironmentMap, [columns, rows]: [u32; 2]) -> Vec<f64> {
    let [width, height] = map.size_px();
    let mut energies = vec![0.0; (columns * rows) as usize];
    let polar_cosine = |y: f64| (y / f64::from(height) * PI).cos();
    for y in 0..height {
        // The pixel's rows in the table: it may cover several, or a part of one.
        let [top, bottom] = [f64::from(y), f64::from(y) + 1.0]
            .map(|y| 0.5 * (1.0 - polar_cosine(y)) * f64::from(rows));
        let solid_angle = map.pixel_solid_angle(y);
        for x in 0..width {
            let pixel = map.pixels()[(y * width + x) as usize].as_dvec3();
            let energy = luminance(pixel) * solid_angle;
            let column = (u64::from(x) * u64::from(columns) / u64::from(width)) as u32;
            let first = (top as u32).min(rows - 1);
            let last = (bottom.ceil() as u32).clamp(first + 1, rows);
            for row in first..last {
                let covered = (bottom.min(f64::from(row) + 1.0) - top.max(f64::from(row))).max(0.0);
                let part = if last - first == 1 { 1.0 } else { covered / (bottom - top) };
                energies[(row * columns + column) as usize] += part * energy;
            }
        }
    }
    energies
}

/// The alias table of cells with these energies.
fn alias_table(energies: &[f64]) -> Vec<Cell> {
    let count = energies.len() as f64;
    let whole: f64 = energies.iter().sum();
    let solid_angle = 4.0 * PI / count;
    // Probability of each cell, times the number of cells.
    let mut scaled: Vec<f64> = energies
        .iter()
        .map(|energy| {
            let part = if whole > 0.0 { energy / whole * count } else { 1.0 };
            EVEN_PART + (1.0 - EVEN_PART) * part
        })
        .collect();
    let mut cells: Vec<Cell> = (0..)
        .zip(&scaled)
        .map(|(index, part)| {
            [index, 1.0_f32.to_bits(), ((part / count / solid_angle) as f32).to_bits(), 0]
        })
        .collect();
    let (mut small, mut large): (Vec<usize>, Vec<usize>) =
        (0..scaled.len()).partition(|&index| scaled[index] < 1.0);
    while let (Some(&low), Some(&high)) = (small.last(), large.last()) {
        small.pop();
        cells[low][0] = high as u32;
        cells[low][1] = (scaled[low] as f32).to_bits();
        scaled[high] -= 1.0 - scaled[low];
        if scaled[high] < 1.0 {
            large.pop();
            small.push(high);
        }
    }
    cells
}

/// Keeps the sky of the last scene, since a map's table takes a while.
#[derive(Clone, Default)]
pub struct SkyCache {
    gradient: Option<(scene::Sky, Arc<SampledSky>)>,
    map: Option<Arc<SampledSky>>,
}

impl SkyCache {
    /// The sky that the paths of `scene` see; none if they see none, or if its map is not `at_hand`.
    pub fn sky_of(
        &mut self,
        scene: &Scene,
        at_hand: Option<&Arc<EnvironmentMap>>,
    ) -> Option<Arc<SampledSky>> {
        let rig = &scene.lights.rig;
        if !scene.traces_paths() || rig.is_empty() {
            return None;
        }
        match rig.kind {
            RigKind::None => None,
            RigKind::Sky => {
                // The sun is a light of its own.
                let gradient = scene::Sky {
                    zenith: rig.sky.zenith,
                    horizon: rig.sky.horizon,
                    ground: rig.sky.ground,
                    ..scene::Sky::default()
                };
                if self.gradient.as_ref().is_none_or(|(old, _)| *old != gradient) {
                    let sky = Arc::new(SampledSky::of_gradient(&gradient));
                    self.gradient = Some((gradient, sky));
                }
                self.gradient.as_ref().map(|(_, sky)| sky.clone())
            }
            RigKind::EnvironmentMap => {
                let map = at_hand.filter(|map| map.name() == rig.environment_map.name)?;
                if self.map.as_ref().is_none_or(|old| old.map.id() != map.id()) {
                    self.map = Some(Arc::new(SampledSky::of_map(map)));
                }
                self.map.clone()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// The direction at the middle of a cell, in the sky's own frame.
    fn cell_direction([column, row]: [u32; 2], [columns, rows]: [u32; 2]) -> DVec3 {
        let z = 1.0 - 2.0 * (f64::from(row) + 0.5) / f64::from(rows);
        let azimuth = 2.0 * PI * ((f64::from(column) + 0.5) / f64::from(columns) - 0.5);
        let aside = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(aside * azimuth.sin(), aside * azimuth.cos(), z)
    }

    /// Probability of each cell, as the table selects them.
    fn probabilities(cells: &[Cell]) -> Vec<f64> {
        let mut found = vec![0.0; cells.len()];
        let each = 1.0 / cells.len() as f64;
        for (index, cell) in cells.iter().enumerate() {
            let stays = f64::from(f32::from_bits(cell[1])).min(1.0);
            found[index] += each * stays;
            found[cell[0] as usize] += each * (1.0 - stays);
        }
        found
    }

    #[test]
    fn cells_are_selected_with_their_densities() {
        let sun = DVec3::new(0.3, 0.5, 0.8).normalize();
        let map = EnvironmentMap::from_fn("", [96, 48], |d| {
            DVec3::splat(if d.dot(sun) > 0.99 { 500.0 } else { 0.2 + 0.1 * d.z })
        });
        let energy = luminance(map.energy());
        let sky = SampledSky::of_map(&Arc::new(map));
        assert!((sky.energy() / energy - 1.0).abs() < 1e-9, "{} of {energy}", sky.energy());
        let solid_angle = 4.0 * PI / sky.cells().len() as f64;
        for (cell, found) in sky.cells().iter().zip(probabilities(sky.cells())) {
            let expected = f64::from(f32::from_bits(cell[2])) * solid_angle;
            assert!((found - expected).abs() < 1e-6 * (1.0 + expected), "{found}, {expected}");
        }
        let bright = (0..sky.cells().len() as u32).filter(|&index| {
            let at = [index % sky.size()[0], index / sky.size()[0]];
            cell_direction(at, sky.size()).dot(sun) > 0.995
        });
        let in_sun: f64 = bright.map(|index| probabilities(sky.cells())[index as usize]).sum();
        assert!(in_sun > 0.4, "{in_sun} of the samples meet the sun");
    }

    #[test]
    fn a_gradient_has_its_energy_and_a_black_sky_a_table() {
        let gradient = scene::Sky { sun_strength: 0.0, ..scene::Sky::default() };
        let sky = SampledSky::of_gradient(&gradient);
        let rows = 200_000;
        let closed: f64 = (0..rows)
            .map(|i| {
                let z = (f64::from(i) + 0.5) / f64::from(rows) * 2.0 - 1.0;
                let d = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
                luminance(gradient.radiance(d)) * 4.0 * PI / f64::from(rows)
            })
            .sum();
        assert!((sky.energy() / closed - 1.0).abs() < 1e-3, "{} of {closed}", sky.energy());
        let black = EnvironmentMap::from_fn("", [4, 2], |_| DVec3::ZERO);
        let sky = SampledSky::of_map(&Arc::new(black));
        assert!(sky.cells().iter().all(|cell| f32::from_bits(cell[2]) > 0.0));
    }
}
