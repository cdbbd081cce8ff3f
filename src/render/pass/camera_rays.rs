//! Makes the camera ray of each sample; the passes that follow read it.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "camera_rays",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from < Stage::Indirect, record },
};

/// Makes the rays of `trace`: from the eye, or from their surface points if their depths are there.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    recorder.dispatch(&pipeline, params, trace.workgroups());
}
