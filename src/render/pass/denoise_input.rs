//! The input of the denoiser: light over albedo, and its error.

use std::ops::Range;

use crate::render::{
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// The pass. The denoiser records the pass first.
pub const PASS: Pass = Pass {
    name: "denoise_input",
    groups: |layouts| vec![&layouts.frame, &layouts.denoise_input, &layouts.film],
    set: &pipeline_set::DENOISE,
    modes: ONE_MODE,
    record: Record::Within,
};

/// Divides the film by its albedo, in some rows of workgroups.
pub fn record(recorder: &mut Recorder<'_>, rows: Range<u32>) {
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.denoiser.input_group);
    recorder.bind_film();
    recorder.dispatch_rows(&pipeline, DispatchParams::default(), rows);
}
