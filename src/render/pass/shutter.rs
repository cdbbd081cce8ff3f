//! Averages the films of the sub-frames of motion blur.

use crate::render::{
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// The pass. A display of a sub-frame records the pass first.
pub const PASS: Pass = Pass {
    name: "shutter",
    groups: |layouts| vec![&layouts.frame, &layouts.shutter, &layouts.film],
    set: &pipeline_set::SHUTTER,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Puts the mean of all sub-frames up to number `sub_frame` on the film.
pub fn record(recorder: &mut Recorder<'_>, sub_frame: u32) {
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.shutter.group);
    recorder.bind_film();
    let params = DispatchParams { iteration: sub_frame, ..Default::default() };
    recorder.dispatch_plane(&pipeline, params);
}
