//! Light and colour of each sample: to the film, or to `direct` as the source of indirect light.
//!
//! Marches no rays.

use super::indirect;
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{Pass, Record, Recorder},
    schedule::{Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "shade",
    groups: |layouts| {
        vec![&layouts.frame, &layouts.gbuffer, &layouts.film, &layouts.environment_texture]
    },
    set: &pipeline_set::SHADE,
    modes: &[&[("SINGLE", 1)], &[("SINGLE", 0)]],
    record: Record::Trace {
        when: |recorder, trace| {
            trace.from <= Stage::Shade
                && trace.shades()
                && !indirect::computes_direct_light(recorder, trace)
        },
        record,
    },
};

/// Shades the samples of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let params = recorder.dispatch_params(trace, grid);
    // The first mode is for single samples, the second for several samples of a pixel.
    let pipeline = recorder.pipeline(&PASS, usize::from(params.samples != 1));
    recorder.bind_film();
    recorder.bind_environment();
    recorder.dispatch_pixels(&pipeline, params);
}
