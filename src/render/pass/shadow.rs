//! Shadow rays: writes one visibility bit per light for each sample.

use super::shadow_cone;
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
    name: "shadow",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.dequeue],
    set: &pipeline_set::RAYS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from <= Stage::Shadow, record },
};

/// Marches rays to those lights of `trace` that surfaces block, with two dispatches per light.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let [shadow_cone, shadow] = [&shadow_cone::PASS, &PASS].map(|pass| recorder.pipeline(pass, 0));
    let (inputs, work_queues) = (recorder.inputs, &recorder.targets.work_queues);
    work_queues.clear_rays(&recorder.layouts.gpu.queue);
    let marched = trace.lights & inputs.casting();
    let lights = inputs.lights_in_use().iter().filter(|light| (marched >> light.bit) & 1 != 0);
    // Queue 0 holds camera rays.
    for (queue, light) in (1..).zip(lights) {
        let mut slice = recorder.slice(trace, grid);
        slice.ray_queue = queue;
        slice.light_bit = light.bit;
        slice.light_reach = light.shadow_reach;
        slice.light_vector = light.vector;
        slice.light_kind = light.kind;
        recorder.dispatch_queue(&shadow_cone, &work_queues.enqueue_rays, slice, Queue::HitBlocks);
        recorder.dispatch_queue(&shadow, &work_queues.reading, slice, Queue::Rays(queue));
    }
}
