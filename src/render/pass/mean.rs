//! The film's mean colour and mean log luminance, by mip levels.

use super::reduce;
use crate::render::{
    display_parts::{DisplayPart, PartRange},
    pipeline_set,
    post::{FIRST_LEVEL, Levels},
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Display,
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "mean",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PartRange::only(DisplayPart::Statistics),
        when: |recorder, _| recorder.tasks.mean,
        record,
    },
};

/// Computes all mip levels of the film, down to one element per eye.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    recorder.bind_post();
    let levels = Levels::of(&recorder.inputs.frame);
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.dispatch(&pipeline, DispatchParams::default(), levels.workgroups(FIRST_LEVEL));
    reduce::record(recorder, levels.last());
}
