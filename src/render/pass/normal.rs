//! Computes normals: reads each sample's depth, writes its normal.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
    work_queues::Queue,
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "normal",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.dequeue],
    set: &pipeline_set::NORMALS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from <= Stage::Normal, record },
};

/// Computes the normals of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    recorder.dispatch_queue(
        &pipeline,
        &recorder.targets.work_queues.dequeue,
        params,
        Queue::HitPoints,
    );
}
