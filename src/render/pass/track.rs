//! Follows camera rays through the set as a medium, to their first collisions.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Trace,
    work_queues::{CAMERA_RAYS, Queue},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "track",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.dequeue, &layouts.paths],
    set: &pipeline_set::MEDIUM,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, _| true, record },
};

/// Follows the camera rays of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    recorder.bind_paths();
    let params = recorder.dispatch_params(trace, grid);
    recorder.dispatch_queue(
        &pipeline,
        &recorder.targets.work_queues.dequeue,
        params,
        Queue::Rays(CAMERA_RAYS),
    );
}
