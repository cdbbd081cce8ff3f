//! A uniform kernel over a mip level, along x, then along y (thesis 4.5, "Bloom").

use crate::render::{
    pipeline_set,
    post::{BlurKernel, Levels},
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "blur",
    groups: |layouts| vec![&layouts.frame, &layouts.post, &layouts.film],
    set: &pipeline_set::POST,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Applies `kernel` once.
pub fn record(recorder: &mut Recorder<'_>, kernel: BlurKernel) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let workgroups = Levels::of(&recorder.inputs.frame).workgroups(kernel.level);
    for axis in 0..2 {
        let BlurKernel { level, half_width } = kernel;
        let params =
            DispatchParams { mip_level: level, axis, half_width, ..DispatchParams::default() };
        recorder.dispatch(&pipeline, params, workgroups);
    }
}
