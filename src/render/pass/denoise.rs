//! The denoiser's iterations: smooth noise, keep edges.

use super::denoise_input;
use crate::render::{
    display_parts::{DenoiserRows, DisplayPart, PartRange},
    lattice::WORKGROUP_SIDE,
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
    first: DisplayPart::Denoise(DenoiserRows { stage: 0, first: 0, end: 0 }),
    last: DisplayPart::Denoise(DenoiserRows { stage: LAST_STAGE, first: u32::MAX, end: u32::MAX }),
};

/// About how many pixels of a stage are submitted together on a CPU adapter: SwiftShader takes up to two microseconds for each.
const CPU_PIXELS: u32 = 1 << 16;

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

/// The denoiser's parts of a display of `size_px`: its stages, of which each reads what the one before it wrote. On a CPU adapter
/// a stage has several parts, of some rows each.
pub fn parts(size_px: [u32; 2], is_cpu: bool) -> impl Iterator<Item = DisplayPart> {
    let [_, all_rows] = size_px.map(|side| side.div_ceil(WORKGROUP_SIDE));
    let rows = match is_cpu {
        true => (CPU_PIXELS / (WORKGROUP_SIDE * size_px[0])).max(1),
        false => all_rows,
    };
    (0..=LAST_STAGE).flat_map(move |stage| {
        (0..all_rows).step_by(rows as usize).map(move |first| {
            let end = all_rows.min(first + rows);
            DisplayPart::Denoise(DenoiserRows { stage, first, end })
        })
    })
}

/// Filters the light of the region.
pub fn record(recorder: &mut Recorder<'_>) {
    denoise_input::record(recorder, recorder.parts.rows_of_denoiser(0));
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind(1, &recorder.targets.denoiser.group);
    recorder.bind_film();
    for iteration in 0..=LAST_ITERATION {
        let params = DispatchParams { iteration, ..Default::default() };
        let rows = recorder.parts.rows_of_denoiser(1 + iteration);
        recorder.dispatch_rows(&pipeline, params, rows);
    }
}
