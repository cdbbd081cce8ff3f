//! Adds indirect light from each sample's neighbours to its direct light, on the film.
//!
//! Marches no rays.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Points, Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "indirect",
    groups: |layouts| vec![&layouts.frame, &layouts.samples, &layouts.film, &layouts.indirect],
    set: &pipeline_set::INDIRECT,
    modes: ONE_MODE,
    record: Record::Trace {
        when: |recorder, trace| {
            trace.shades()
                && (trace.from == Stage::Indirect || computes_direct_light(recorder, trace))
        },
        record,
    },
};

/// Whether the pass also computes the direct light of `trace`.
///
/// Indirect light of centre samples waits until all samples of a level have their direct light.
pub fn computes_direct_light(recorder: &Recorder<'_>, trace: &Trace) -> bool {
    recorder.inputs.has_indirect() && matches!(trace.points, Points::Samples { .. })
}

/// Computes the light of the samples of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let mut params = recorder.dispatch_params(trace, grid);
    if let Points::Indirect(level) = trace.points {
        params.neighbour_level = level;
    }
    recorder.bind_indirect(trace);
    recorder.dispatch_pixels(&pipeline, params);
}
