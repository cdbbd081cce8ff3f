//! What work has cost so far, and how much of it fits a time.
//!
//! A piece of work takes a fixed time, whatever its size, and a time for each pixel. The fixed
//! part is small natively; in a browser the interface's own drawing and the way back of the news
//! can make it many milliseconds, and pieces that shrank for its sake would only add to it. A
//! straight line through recent measurements tells the two apart.

use super::Stage;
use crate::render::lattice::{COARSEST, Grid, WORKGROUP_THREADS};

/// Pixels of the very first slice: small enough for a device 200 times slower than a desktop's.
const FIRST_PIXELS: f64 = 1024.0;

/// Milliseconds a pixel that are assumed before anything is measured.
const ASSUMED_MS: f64 = 0.004;

/// What a measurement weighs against the next one.
const MEMORY: f64 = 0.85;

/// What it weighs against one so many times above what was expected: slices then shrink at once.
const SURPRISE: f64 = 2.0;
const MEMORY_AFTER_SURPRISE: f64 = 0.3;

/// Fewest workgroups of a slice: two can be halved, and slices of two sizes keep telling what is
/// fixed. Were they all of one workgroup, their own smallness could never be found to be the trouble.
const FEWEST_WORKGROUPS: f64 = 2.0;

/// Most of the mean time that may count as fixed: the rest keeps slices from growing at once.
const MOST_FIXED: f64 = 0.95;

/// Weighted sums over measurements of pixels and milliseconds.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    weight: f64,
    pixels: f64,
    ms: f64,
    pixels_squared: f64,
    pixels_ms: f64,
}

impl Sums {
    fn add(&mut self, memory: f64, pixels: f64, ms: f64) {
        *self = Self {
            weight: self.weight * memory + 1.0,
            pixels: self.pixels * memory + pixels,
            ms: self.ms * memory + ms,
            pixels_squared: self.pixels_squared * memory + pixels * pixels,
            pixels_ms: self.pixels_ms * memory + pixels * ms,
        };
    }

    /// The fixed part of the line of least squares; none where all slices were of one size.
    fn fixed_ms(&self) -> Option<f64> {
        let (pixels, ms) = (self.pixels / self.weight, self.ms / self.weight);
        let variance = self.pixels_squared / self.weight - pixels * pixels;
        let covariance = self.pixels_ms / self.weight - pixels * ms;
        (variance > 0.01 * pixels * pixels).then(|| ms - covariance.max(0.0) / variance * pixels)
    }
}

/// The cost of one kind of trace.
#[derive(Clone, Copy, Debug)]
struct Rate {
    fixed_ms: f64,
    pixel_ms: f64,
    sums: Sums,
    /// Pixels of the largest slice so far that was measured.
    largest_px: f64,
}

impl Rate {
    const UNKNOWN: Self = Self {
        fixed_ms: 0.0,
        pixel_ms: ASSUMED_MS,
        sums: Sums { weight: 0.0, pixels: 0.0, ms: 0.0, pixels_squared: 0.0, pixels_ms: 0.0 },
        largest_px: FIRST_PIXELS / 2.0,
    };

    fn is_measured(&self) -> bool {
        self.sums.weight > 0.0
    }

    fn learn(&mut self, pixels: f64, ms: f64) {
        let is_surprise = ms > SURPRISE * (self.fixed_ms + self.pixel_ms * pixels);
        self.sums.add(if is_surprise { MEMORY_AFTER_SURPRISE } else { MEMORY }, pixels, ms);
        let mean_ms = self.sums.ms / self.sums.weight;
        let fixed_ms = self.sums.fixed_ms().unwrap_or(self.fixed_ms);
        self.fixed_ms = fixed_ms.clamp(0.0, MOST_FIXED * mean_ms);
        self.pixel_ms = (mean_ms - self.fixed_ms) / (self.sums.pixels / self.sums.weight);
        self.largest_px = self.largest_px.max(pixels);
    }
}

/// Running estimates of what traces and shows cost.
#[derive(Clone, Debug)]
pub struct Cost {
    /// Of traces that start with each [`Stage`].
    rates: [Rate; 4],
    show_ms: f64,
}

impl Default for Cost {
    /// No experience yet.
    fn default() -> Self {
        Self { rates: [Rate::UNKNOWN; 4], show_ms: 0.0 }
    }
}

impl Cost {
    /// A slice of so many pixels that started with `from` took so long.
    pub fn traced(&mut self, from: Stage, pixels: u32, busy_ms: f64) {
        if pixels > 0 {
            self.rates[from as usize].learn(f64::from(pixels), busy_ms.max(1e-3));
        }
    }

    /// A show took so long.
    pub fn shown(&mut self, busy_ms: f64) {
        self.show_ms += 0.5 * (busy_ms - self.show_ms);
    }

    /// What a show takes, milliseconds.
    pub fn show_ms(&self) -> f64 {
        self.show_ms
    }

    fn rate(&self, from: Stage) -> Rate {
        let own = self.rates[from as usize];
        // A later start never costs more than an earlier one.
        let dearer = self.rates[..from as usize].iter().rev().find(|rate| rate.is_measured());
        match dearer {
            Some(dearer) if !own.is_measured() => {
                Rate { fixed_ms: dearer.fixed_ms, pixel_ms: dearer.pixel_ms, ..own }
            }
            _ => own,
        }
    }

    /// Workgroups of a slice whose pixels are to take `aim_ms`, or as long as the fixed part does
    /// where that is longer: never more than twice the largest slice that has been seen to end
    /// well, and two at least.
    pub fn slice_workgroups(&self, aim_ms: f64, from: Stage) -> u32 {
        let rate = self.rate(from);
        let pixels = (aim_ms.max(rate.fixed_ms) / rate.pixel_ms).min(2.0 * rate.largest_px);
        (pixels / f64::from(WORKGROUP_THREADS)).clamp(FEWEST_WORKGROUPS, 1e9) as u32
    }

    /// The finest lattice level of a region that fits `budget_ms` together with its display.
    /// `gathers`: its indirect light too.
    pub fn level_within(
        &self,
        budget_ms: f64,
        from: Stage,
        gathers: bool,
        size_px: [u32; 2],
    ) -> u32 {
        let mut rate = self.rate(from);
        if gathers {
            let gather = self.rate(Stage::Gather);
            rate.fixed_ms += gather.fixed_ms;
            rate.pixel_ms += gather.pixel_ms;
        }
        // At least a quarter of the budget goes into the lattice's pixels, however slow the
        // display and the way to it.
        let left_ms = (budget_ms - self.show_ms - rate.fixed_ms).max(0.25 * budget_ms);
        let fits =
            |level| f64::from(Grid::level(level, size_px).threads()) * rate.pixel_ms <= left_ms;
        (0..COARSEST).find(|&level| fits(level)).unwrap_or(COARSEST)
    }
}
