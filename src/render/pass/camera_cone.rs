//! Cones of camera rays: queues the blocks of samples that may hit, and the depth to which they are clear.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "camera_cone",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.enqueue, &layouts.moments],
    set: &pipeline_set::RAYS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from <= Stage::March, record },
};

/// Marches the cones of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    let work_queues = &recorder.targets.work_queues;
    recorder.bind_moments();
    work_queues.clear_rays(&recorder.layouts.gpu.queue);
    recorder.dispatch_blocks(&pipeline, &work_queues.enqueue_rays, params);
}
