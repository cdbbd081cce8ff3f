//! Shadow rays: writes one visibility bit per light for each sample.

use super::shadow_cone;
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::{Stage, Trace},
    work_queues::{CAMERA_RAYS, Queue},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "shadow",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.dequeue, &layouts.paths],
    set: &pipeline_set::RAYS,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, trace| trace.from <= Stage::Shadow, record },
};

/// Marches rays to the lights of `trace` that cast shadows: two dispatches per light.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let [shadow_cone, shadow] = [&shadow_cone::PASS, &PASS].map(|pass| recorder.pipeline(pass, 0));
    let (inputs, work_queues) = (recorder.inputs, &recorder.targets.work_queues);
    recorder.bind_paths();
    work_queues.clear_rays(&recorder.layouts.gpu.queue);
    let marched = trace.lights & inputs.casting();
    let lights = inputs.lights_in_use().iter().filter(|light| (marched >> light.bit) & 1 != 0);
    // A rehearsal has a light even if the scene has none.
    let rehearsed = recorder.rehearsal.is_some().then_some(&inputs.lights[0]);
    for (queue, light) in (CAMERA_RAYS + 1..).zip(lights.chain(rehearsed)) {
        let mut params = recorder.dispatch_params(trace, grid);
        params.ray_queue = queue;
        params.light_bit = light.bit;
        params.light_reach = light.shadow_reach;
        params.light_vector = light.vector;
        params.light_kind = light.kind;
        params.light_size = light.size;
        params.light_seed = light.seed;
        recorder.dispatch_queue(&shadow_cone, &work_queues.enqueue_rays, params, Queue::HitBlocks);
        recorder.dispatch_queue(&shadow, &work_queues.dequeue, params, Queue::Rays(queue));
    }
}
