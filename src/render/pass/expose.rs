//! Auto exposure from the film's mean.

use crate::render::{
    display_parts::{DisplayPart, PartRange},
    pipeline_set,
    post::Levels,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Display,
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "expose",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PartRange::only(DisplayPart::Statistics),
        when: |recorder, _| recorder.tasks.adapt.is_some(),
        record,
    },
};

/// Moves exposure toward its goal.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    let Some(adapt) = recorder.tasks.adapt else { return };
    recorder.bind_post();
    let pipeline = recorder.pipeline(&PASS, 0);
    let last = Levels::of(&recorder.inputs.frame).last();
    // Without a new mean, the pass uses the mean in the statistics: level 0.
    let mip_level = if recorder.tasks.mean { last } else { 0 };
    recorder.dispatch(
        &pipeline,
        DispatchParams { mip_level, adapt, ..DispatchParams::default() },
        1,
    );
}
