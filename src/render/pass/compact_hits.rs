//! Queues the blocks of samples that have surface points.

use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "compact_hits",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.enqueue],
    set: &pipeline_set::ALWAYS,
    modes: ONE_MODE,
    record: Record::Trace {
        when: |recorder, trace| {
            trace.from <= Stage::Normal || trace.lights & recorder.inputs.casting() != 0
        },
        record,
    },
};

/// Queues the surface points of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipeline(&PASS, 0);
    let params = recorder.dispatch_params(trace, grid);
    let work_queues = &recorder.targets.work_queues;
    work_queues.clear_hits(&recorder.layouts.gpu.queue);
    recorder.dispatch_blocks(&pipeline, &work_queues.enqueue_hits, params);
}
