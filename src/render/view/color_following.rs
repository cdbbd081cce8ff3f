//! The colour curves of a view, and how far their measurement has come.

use crate::{
    gpu::readback::Readback,
    render::{color_curve::LayerCurves, schedule::Stale, uniforms::Inputs},
};

/// The colour curves of a view, and their measurement.
#[derive(Default)]
pub struct ColorFollowing {
    /// The layers' curves in use; none before the first measurement.
    pub curves: Option<LayerCurves>,
    /// Curves borrowed from a view of the whole picture.
    pub lent: Option<LayerCurves>,
    /// The lattice level of the current picture that was measured last.
    pub measured: Option<u32>,
    /// The pending measurement.
    pub reading: Option<Reading>,
    /// Whether the curves are those of the picture's complete centre samples.
    pub is_settled: bool,
}

/// A measurement in readback.
pub struct Reading {
    /// The counts.
    pub readback: Readback,
    /// The greatest values that can be counted in each layer.
    pub ranges: [f64; 2],
    /// Whether all centre samples of the current picture are counted.
    pub is_complete: bool,
}

impl ColorFollowing {
    /// The curves to draw with.
    pub fn curves(&self) -> Option<&LayerCurves> {
        self.lent.as_ref().or(self.curves.as_ref())
    }

    /// Discards what was measured if `new` inputs have other colour values than `old` ones.
    pub fn follow(&mut self, old: Option<&Inputs>, new: &Inputs) {
        let has_same_values = old.is_some_and(|old| {
            let follows = |inputs: &Inputs| inputs.layers().map(|layer| layer.follows_view);
            new.stale_since(old) < Some(Stale::Geometry)
                && new.has_color_values_of(old)
                && follows(new) == follows(old)
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
