//! Adds indirect light from each sample's neighbours to its direct light, on the film.
//!
//! Marches no rays.

use crate::render::recorder::{ONE_MODE, Pass, Record};
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::Recorder,
    schedule::{Points, Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "indirect",
    groups: |layouts| vec![&layouts.frame, &layouts.samples, &layouts.film, &layouts.indirect],
    set: &pipeline_set::INDIRECT,
    modes: ONE_MODE,
    record: Record::Trace {
        when: |recorder, trace| trace.from == Stage::Indirect || recorder.is_lit_together(trace),
        record,
    },
};

/// Computes the light of the samples of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let mut slice = recorder.slice(trace, grid);
    if let Points::Indirect(level) = trace.points {
        slice.neighbour_level = level;
    }
    recorder.bind_indirect(trace);
    recorder.dispatch_pixels(&pipeline, slice);
    recorder.dispatches.indirect += 1;
}
