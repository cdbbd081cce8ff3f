//! Bloom: reduces the light above the threshold to a mip level and blurs it there.

use super::{blur, reduce};
use crate::render::{
    display_parts::{DisplayPart, PartRange},
    pipeline_set,
    post::{BlurKernel, FIRST_LEVEL, Levels},
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Display,
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "bloom",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PartRange::only(DisplayPart::Bloom),
        when: |recorder, _| recorder.tasks.bloom,
        record,
    },
};

/// Leaves the blurred light in the mip level that the statistics name.
pub fn record(recorder: &mut Recorder<'_>, _display: &Display) {
    recorder.bind_post();
    let picture = &recorder.inputs.frame;
    let levels = Levels::of(picture);
    let passes = picture.bloom.passes;
    let kernel = BlurKernel::new(picture.bloom.radius, passes, levels);
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.dispatch(&pipeline, DispatchParams::default(), levels.workgroups(FIRST_LEVEL));
    reduce::record(recorder, kernel.level);
    for _ in 0..passes {
        blur::record(recorder, kernel);
    }
}
