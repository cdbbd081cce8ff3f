//! Extends light paths vertex by vertex; the passes of direct light march their rays, or `track` follows the rays through a
//! medium.

use super::{march, normal, shadow, track};
use crate::render::{
    lattice::Grid,
    pipeline_set,
    recorder::{ONE_MODE, Pass, Record, Recorder},
    schedule::Trace,
    uniforms::DispatchParams,
    work_queues::{Queue, VertexRays},
};

/// The pass.
pub const PASS: Pass = Pass {
    name: "scatter",
    groups: |layouts| vec![&layouts.frame, &layouts.gbuffer, &layouts.enqueue, &layouts.paths],
    set: &pipeline_set::SCATTER,
    modes: ONE_MODE,
    record: Record::Trace { when: |_, _| true, record },
};

/// Follows the paths of `trace` from their first surface points to their ends.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    // A medium has collisions in place of surface points, and no normals.
    let in_medium = recorder.inputs.traces_medium();
    let (marching, shadowing) =
        if in_medium { (&track::PASS, &track::PASS) } else { (&march::PASS, &shadow::PASS) };
    let [march, shadow, scatter] =
        [marching, shadowing, &PASS].map(|pass| recorder.pipeline(pass, 0));
    let normal = (!in_medium).then(|| recorder.pipeline(&normal::PASS, 0));
    let work_queues = &recorder.targets.work_queues;
    recorder.bind_paths();
    let bounces = recorder.inputs.frame.paths.bounces;
    // The last rays only look for lights.
    for bounce in 0..=bounces + 1 {
        let of_rays = |recorder: &mut Recorder<'_>, rays: VertexRays| DispatchParams {
            bounce,
            ray_queue: rays.queue(),
            queue_region: rays.region(),
            light_reach: f32::MAX,
            ..recorder.dispatch_params(trace, grid)
        };
        let (paths, shadows) = (VertexRays::Paths(bounce), VertexRays::Shadows(bounce));
        let params = of_rays(recorder, paths);
        let enqueue = work_queues.enqueue_after(bounce);
        if bounce == 0 {
            recorder.bind(2, enqueue);
            recorder.dispatch(&scatter, params, trace.workgroups());
        } else {
            let queue = Queue::Vertex(paths);
            recorder.dispatch_queue(&march, &work_queues.dequeue, params, queue);
            if let Some(normal) = normal.as_ref().filter(|_| bounce <= bounces) {
                recorder.dispatch_queue(normal, &work_queues.dequeue, params, queue);
            }
            recorder.dispatch_queue(&scatter, enqueue, params, queue);
        }
        if bounce <= bounces {
            let params = of_rays(recorder, shadows);
            let queue = Queue::Vertex(shadows);
            recorder.dispatch_queue(&shadow, &work_queues.dequeue, params, queue);
        }
    }
}
