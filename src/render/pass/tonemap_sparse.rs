//! Tone maps the samples of a sparse lattice to display values.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::KeptPixels,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "tonemap_sparse",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.film],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Sparse { record },
};

/// Tone maps every sample of a lattice level.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let grid = Grid::level(level, recorder.inputs.frame.size_px);
    recorder.dispatch_grid(&pipeline, &grid, 1 << (level / 2), KeptPixels::default());
}
