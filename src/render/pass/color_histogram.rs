//! Counts a lattice's hits by the value that selects their colour.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::KeptPixels,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "color_histogram",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.color_bins],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Counts the hits of the centre samples of a lattice level.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let bins = &recorder.targets.color_bins;
    // Writes take effect with the submit, before its passes.
    recorder.layouts.gpu.queue.write_buffer(bins, 0, &vec![0; bins.size() as usize]);
    recorder.bind_color_bins();
    let pipeline = recorder.pipeline(&PASS, 0);
    let grid = Grid::level(level, recorder.inputs.frame.size_px);
    recorder.dispatch_grid(&pipeline, &grid, 0, KeptPixels::default());
}
