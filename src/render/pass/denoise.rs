//! The denoiser's iterations: smooth noise, keep edges.

use super::denoise_input;
use crate::render::{
    display_parts::{DisplayPart, PartRange},
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

/// All iterations.
const PARTS: PartRange =
    PartRange { first: DisplayPart::Denoise(0), last: DisplayPart::Denoise(LAST_ITERATION) };

/// The pass.
pub const PASS: Pass = Pass {
    name: "denoise",
    groups: |layouts| vec![&layouts.frame, &layouts.denoise, &layouts.film],
    set: &pipeline_set::DENOISE,
    modes: ONE_MODE,
    record: Record::Film {
        parts: PARTS,
        when: |recorder, _| recorder.denoises,
        record: |recorder, _| record(recorder),
    },
};

/// The denoiser's parts of a display.
pub fn parts() -> impl Iterator<Item = DisplayPart> {
    (0..=LAST_ITERATION).map(DisplayPart::Denoise)
}

/// Filters the light of the whole region.
pub fn record(recorder: &mut Recorder<'_>) {
    if recorder.parts.contains(DisplayPart::Denoise(0)) {
        denoise_input::record(recorder);
    }
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.denoiser.group);
    recorder.bind_film();
    for iteration in 0..=LAST_ITERATION {
        if recorder.parts.contains(DisplayPart::Denoise(iteration)) {
            recorder.dispatch_plane(&pipeline, DispatchParams { iteration, ..Default::default() });
        }
    }
}
