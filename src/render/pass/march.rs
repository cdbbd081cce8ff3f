//! Marches camera rays to surface points: writes depth and colour data of each sample.

use crate::render::recorder::{ONE_MODE, Pass, Record};
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::Recorder,
    schedule::{Stage, Trace},
    work_queues::Queue,
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
    let slice = recorder.slice(trace, grid);
    recorder.dispatch_queue(
        &pipeline,
        &recorder.targets.work_queues.reading,
        slice,
        Queue::Rays(0),
    );
}
