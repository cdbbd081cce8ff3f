//! Upsamples the tone-mapped samples of a sparse lattice to the display picture.

use crate::render::recorder::{ONE_MODE, Pass, Record};
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{Display, Recorder},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "upsample",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.film],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Display { when: |recorder, _| recorder.upsample_level.is_some(), record },
};

/// Makes the whole region's display picture from a tone-mapped lattice level.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    let Some(level) = recorder.upsample_level else { return };
    recorder.bind_jittered();
    let pipeline = recorder.pipeline(&PASS, 0);
    let slice = Grid::level(level, recorder.inputs.frame.size_px).slice(0);
    recorder.dispatch_plane(&pipeline, slice);
}
