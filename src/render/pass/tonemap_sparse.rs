//! Tone maps the samples of a sparse lattice to display values.

use crate::render::recorder::{ONE_MODE, Pass, Record};
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{Display, Recorder},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "tonemap_sparse",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.film],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Display { when: |recorder, _| recorder.upsample_level.is_some(), record },
};

/// Tone maps every sample of a lattice level.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    let Some(level) = recorder.upsample_level else { return };
    recorder.bind_jittered();
    let pipeline = recorder.pipeline(&PASS, 0);
    let grid = Grid::level(level, recorder.inputs.frame.size_px);
    recorder.dispatch_grid(&pipeline, &grid, 1 << (level / 2));
}
