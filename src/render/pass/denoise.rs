//! The denoiser's iterations: smooth noise, keep edges.

use super::denoise_input;
use crate::render::{
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    uniforms::DispatchParams,
};

/// Number of the last iteration; `LAST_ITERATION` in `shaders/pass/denoise.wgsl`.
const LAST_ITERATION: u32 = 4;

/// Distance to the farthest pixel that a denoised pixel depends on, pixels, along each side.
///
/// Two steps of each iteration, and two pixels for the error; a multiple of a workgroup's side.
pub const REACH_PX: u32 = 64;

const _: () = assert!(REACH_PX >= 2 * ((2 << LAST_ITERATION) - 1) + 2);

/// The pass.
pub const PASS: Pass = Pass {
    name: "denoise",
    groups: |layouts| vec![&layouts.frame, &layouts.denoise, &layouts.film],
    set: &pipeline_set::DENOISE,
    modes: ONE_MODE,
    record: Record::Film {
        when: |recorder, _| recorder.denoises,
        record: |recorder, _| record(recorder),
    },
};

/// Filters the light of the whole region.
pub fn record(recorder: &mut Recorder<'_>) {
    denoise_input::record(recorder);
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.denoiser.group);
    recorder.bind_film();
    for iteration in 0..=LAST_ITERATION {
        recorder.dispatch_plane(&pipeline, DispatchParams { iteration, ..Default::default() });
    }
}
