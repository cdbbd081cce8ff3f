//! The film's histogram.

use crate::render::{
    display_parts::{DisplayPart, PartRange},
    pipeline_set,
    post::{FIRST_LEVEL, Levels},
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Display,
    uniforms::{DispatchParams, Statistics},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "histogram",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PartRange::only(DisplayPart::Statistics),
        when: |recorder, _| recorder.tasks.histogram,
        record,
    },
};

/// Counts the film's pixels by luminance.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    recorder.bind_post();
    // Writes take effect with the submit, before its passes.
    let (_, first_bin, bytes) = Statistics::LAYOUT[Statistics::LAYOUT.len() - 1];
    recorder.layouts.gpu.queue.write_buffer(
        &recorder.post.statistics,
        first_bin as u64,
        &vec![0; bytes],
    );
    let pipeline = recorder.pipeline(&PASS, 0);
    let workgroups = Levels::of(&recorder.inputs.frame).workgroups(FIRST_LEVEL);
    recorder.dispatch(&pipeline, DispatchParams::default(), workgroups);
}
