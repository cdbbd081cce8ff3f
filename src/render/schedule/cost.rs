//! What work has cost so far, and how much of it fits a time.

use crate::render::lattice::{COARSEST, Grid, WORKGROUP_THREADS};

/// Pixels of the very first slice: small enough for a device 200 times slower than a desktop's.
const FIRST_PIXELS: f64 = 1024.0;

/// Milliseconds a pixel that are assumed before anything is measured.
const ASSUMED_MS: f64 = 0.004;

/// How far a cheaper measurement pulls the estimate down; a dearer one raises it at once.
const RELAX: f64 = 0.35;

/// The cost of one kind of trace.
#[derive(Clone, Copy, Debug)]
struct Rate {
    /// Milliseconds a pixel.
    ms: f64,
    /// Pixels of the largest slice so far that was measured.
    largest_px: f64,
    measured: bool,
}

impl Rate {
    const UNKNOWN: Self = Self { ms: ASSUMED_MS, largest_px: FIRST_PIXELS / 2.0, measured: false };

    fn learn(&mut self, pixels: f64, busy_ms: f64) {
        let ms = busy_ms / pixels;
        self.ms =
            if !self.measured || ms > self.ms { ms } else { self.ms + RELAX * (ms - self.ms) };
        self.measured = true;
        self.largest_px = self.largest_px.max(pixels);
    }
}

/// Running estimates of what traces and shows cost.
#[derive(Clone, Debug)]
pub struct Cost {
    march: Rate,
    light: Rate,
    show_ms: f64,
}

impl Default for Cost {
    /// No experience yet.
    fn default() -> Self {
        Self { march: Rate::UNKNOWN, light: Rate::UNKNOWN, show_ms: 0.0 }
    }
}

impl Cost {
    /// A slice of so many pixels took so long; `march` where camera rays were part of it.
    pub fn traced(&mut self, march: bool, pixels: u32, busy_ms: f64) {
        let rate = if march { &mut self.march } else { &mut self.light };
        rate.learn(f64::from(pixels), busy_ms.max(1e-3));
    }

    /// A show took so long.
    pub fn shown(&mut self, busy_ms: f64) {
        self.show_ms += 0.5 * (busy_ms - self.show_ms);
    }

    /// What a show takes, milliseconds.
    pub fn show_ms(&self) -> f64 {
        self.show_ms
    }

    fn rate(&self, march: bool) -> Rate {
        // Shading again never costs more than marching and shading.
        let known = if march { self.march } else { self.light };
        if known.measured || march { known } else { Rate { ms: self.march.ms, ..self.light } }
    }

    /// Workgroups of a slice that is to take `aim_ms`: never more than twice the largest slice
    /// that has been seen to end well.
    pub fn slice_workgroups(&self, aim_ms: f64, march: bool) -> u32 {
        let rate = self.rate(march);
        let pixels = (aim_ms / rate.ms).min(2.0 * rate.largest_px);
        (pixels / f64::from(WORKGROUP_THREADS)).clamp(1.0, 1e9) as u32
    }

    /// The finest lattice level of a region that fits `budget_ms` together with its display.
    pub fn level_within(&self, budget_ms: f64, march: bool, size_px: [u32; 2]) -> u32 {
        // At least a quarter of the budget goes into the lattice, however slow the display.
        let left_ms = (budget_ms - self.show_ms).max(0.25 * budget_ms);
        let rate = self.rate(march);
        let fits = |level| f64::from(Grid::level(level, size_px).threads()) * rate.ms <= left_ms;
        (0..COARSEST).find(|&level| fits(level)).unwrap_or(COARSEST)
    }
}
