//! Oracle: light that spreads, in f64, from the definition in docs/tone.md.

use glam::DVec3;
use mandelight::scene::{Bloom, BloomOrder, Tone};

use super::tone::curve;

/// A mip level's elements, and how many pixels each column and row of it is wide.
struct Level {
    spacing: usize,
    columns: Vec<f64>,
    rows: Vec<f64>,
    elements: Vec<DVec3>,
}

impl Level {
    /// Means over squares of `spacing` pixels, cut off at the right and lower edges.
    fn new(spacing: usize, [width, height]: [usize; 2], pixels: &[DVec3]) -> Self {
        let spans = |side: usize| -> Vec<f64> {
            (0..side).step_by(spacing).map(|at| (side - at).min(spacing) as f64).collect()
        };
        let (columns, rows) = (spans(width), spans(height));
        let mut elements = vec![DVec3::ZERO; columns.len() * rows.len()];
        for (i, color) in pixels.iter().enumerate() {
            let (x, y) = (i % width / spacing, i / width / spacing);
            elements[y * columns.len() + x] += *color / (columns[x] * rows[y]);
        }
        Self { spacing, columns, rows, elements }
    }

    /// The mean over a square of twice `half_width` elements a side about each element's middle,
    /// of what of it lies inside.
    fn blurred(&self, half_width: f64) -> Vec<DVec3> {
        let covered = |offset: usize| {
            let (from, to) = (offset as f64 - 0.5, offset as f64 + 0.5);
            (to.min(half_width) - from.max(-half_width)).max(0.0)
        };
        let wide = self.columns.len();
        (0..self.elements.len())
            .map(|i| {
                let (x, y) = (i % wide, i / wide);
                let (mut sum, mut total) = (DVec3::ZERO, 0.0);
                for (j, color) in self.elements.iter().enumerate() {
                    let (u, v) = (j % wide, j / wide);
                    let weight = covered(u.abs_diff(x))
                        * covered(v.abs_diff(y))
                        * self.columns[u]
                        * self.rows[v];
                    sum += weight * *color;
                    total += weight;
                }
                sum / total
            })
            .collect()
    }

    /// Between the middles of elements, linearly.
    fn at(&self, [x, y]: [usize; 2]) -> DVec3 {
        let place = |pixel: usize, count: usize| {
            let at = (pixel as f64 + 0.5) / self.spacing as f64 - 0.5;
            let at = at.clamp(0.0, (count - 1) as f64);
            (at.floor() as usize, (at.floor() as usize + 1).min(count - 1), at.fract())
        };
        let wide = self.columns.len();
        let (left, right, across) = place(x, wide);
        let (above, below, down) = place(y, self.rows.len());
        let row =
            |y: usize| self.elements[y * wide + left].lerp(self.elements[y * wide + right], across);
        row(above).lerp(row(below), down)
    }
}

/// What has spread to each pixel.
fn spread(bloom: &Bloom, size_px: [usize; 2], source: &[DVec3]) -> Vec<DVec3> {
    let bright: Vec<_> = source
        .iter()
        .map(|color| {
            let l = color.dot(DVec3::new(0.2126, 0.7152, 0.0722));
            if l > bloom.threshold { *color * (1.0 - bloom.threshold / l) } else { DVec3::ZERO }
        })
        .collect();
    let half_width_px = bloom.radius * size_px[1] as f64 / f64::from(bloom.passes).sqrt();
    let level = (2..).find(|n| half_width_px / f64::from(1 << n) <= 6.0).expect("some level");
    let mut level = Level::new(1 << level, size_px, &bright);
    for _ in 0..bloom.passes {
        level.elements = level.blurred(half_width_px / level.spacing as f64);
    }
    (0..size_px[0] * size_px[1]).map(|i| level.at([i % size_px[0], i / size_px[0]])).collect()
}

/// The display's linear light, 0 to 1, of exposed pixels.
pub fn shown(tone: &Tone, bloom: &Bloom, size_px: [usize; 2], exposed: &[DVec3]) -> Vec<DVec3> {
    let curved: Vec<_> = exposed.iter().map(|color| curve(tone, *color)).collect();
    let source = if bloom.order == BloomOrder::After { &curved } else { exposed };
    let spread = spread(bloom, size_px, source);
    let added = |color: &DVec3, light: &DVec3| *color + bloom.strength * *light;
    match bloom.order {
        BloomOrder::After => {
            curved.iter().zip(&spread).map(|(c, s)| added(c, s).min(DVec3::ONE)).collect()
        }
        BloomOrder::Before => {
            exposed.iter().zip(&spread).map(|(c, s)| curve(tone, added(c, s))).collect()
        }
    }
}
