//! Upsamples the tone-mapped samples of a sparse lattice to the display picture.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "upsample",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.film],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Sparse { record },
};

/// Makes the whole region's display picture from a tone-mapped lattice level.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = Grid::level(level, recorder.inputs.frame.size_px).dispatch_params(0);
    recorder.dispatch_plane(&pipeline, params);
}
