//! The colour curve of a view, and how far its measurement has come.

use crate::{
    gpu::readback::Readback,
    render::{color_curve::ColorCurve, schedule::Stale, uniforms::Inputs},
};

/// The colour curve of a view, and its measurement.
#[derive(Default)]
pub struct ColorFollowing {
    /// The curve in use; none before the first measurement.
    pub curve: Option<ColorCurve>,
    /// A curve borrowed from a view of the whole picture.
    pub lent: Option<ColorCurve>,
    /// The lattice level of the current picture that was measured last.
    pub measured: Option<u32>,
    /// The pending measurement.
    pub reading: Option<Reading>,
    /// Whether the curve is that of the picture's complete centre samples.
    pub is_settled: bool,
}

/// A measurement in readback.
pub struct Reading {
    /// The counts.
    pub readback: Readback,
    /// The greatest value that can be counted.
    pub range: f64,
    /// Whether all centre samples of the current picture are counted.
    pub is_complete: bool,
}

impl ColorFollowing {
    /// The curve to draw with.
    pub fn curve(&self) -> Option<&ColorCurve> {
        self.lent.as_ref().or(self.curve.as_ref())
    }

    /// Discards what was measured if `new` inputs have other colour values than `old` ones.
    pub fn follow(&mut self, old: Option<&Inputs>, new: &Inputs) {
        let has_same_values = old.is_some_and(|old| {
            let (old_surface, new_surface) = (&old.frame.surface, &new.frame.surface);
            new.stale_since(old) < Some(Stale::Geometry)
                && old_surface.color_source == new_surface.color_source
                && old_surface.color_follows == new_surface.color_follows
        });
        if !has_same_values {
            self.measured = None;
            self.is_settled = false;
            if let Some(reading) = &mut self.reading {
                reading.is_complete = false;
            }
        }
    }
}
