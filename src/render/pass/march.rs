//! Marches rays to surface points: writes depth and colour data, and moves the ray there.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
    work_queues::{CAMERA_RAYS, Queue},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "march",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.dequeue],
    set: &pipeline_set::RAYS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from <= Stage::March, record },
};

/// Marches the rays of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    recorder.dispatch_queue(
        &pipeline,
        &recorder.targets.work_queues.dequeue,
        params,
        Queue::Rays(CAMERA_RAYS),
    );
}
