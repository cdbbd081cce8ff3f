//! Computes mip levels from the finest level.

use crate::render::{
    pipeline_set,
    post::{FIRST_LEVEL, Levels},
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "reduce",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Computes every level up to `last`.
pub fn record(recorder: &mut Recorder<'_>, last: u32) {
    let pipeline = recorder.pipeline(&PASS, 0);
    for level in FIRST_LEVEL..last {
        let workgroups = Levels::of(&recorder.inputs.frame).workgroups(level + 1);
        let params = DispatchParams { mip_level: level, ..DispatchParams::default() };
        recorder.dispatch(&pipeline, params, workgroups);
    }
}
