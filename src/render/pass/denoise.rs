//! The denoiser's iterations: smooth noise, keep edges.

use super::denoise_input;
use crate::render::{
    display_parts::{DisplayPart, PartRange, Rows},
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

/// Number of the last stage: the input is made in stage 0, and iterations follow.
const LAST_STAGE: u32 = 1 + LAST_ITERATION;

/// All rows of all stages.
const PARTS: PartRange = PartRange {
    first: DisplayPart::Denoise(0, Rows { first: 0, end: 0 }),
    last: DisplayPart::Denoise(LAST_STAGE, Rows { first: u32::MAX, end: u32::MAX }),
};

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

/// The denoiser's parts of a display: its stages, of which each reads what the one before it wrote, in these `runs` of rows.
pub fn parts(runs: impl Iterator<Item = Rows> + Clone) -> impl Iterator<Item = DisplayPart> {
    (0..=LAST_STAGE)
        .flat_map(move |stage| runs.clone().map(move |rows| DisplayPart::Denoise(stage, rows)))
}

/// Filters the light of the region.
pub fn record(recorder: &mut Recorder<'_>) {
    let parts = recorder.parts;
    let rows_of = |stage| parts.rows_of(|rows| DisplayPart::Denoise(stage, rows));
    denoise_input::record(recorder, rows_of(0));
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.denoiser.group);
    recorder.bind_film();
    for iteration in 0..=LAST_ITERATION {
        let params = DispatchParams { iteration, ..Default::default() };
        recorder.dispatch_rows(&pipeline, params, rows_of(1 + iteration));
    }
}
