//! Shadow rays: writes one visibility bit a light for each sample.

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        lattice::{Grid, WORKGROUP_THREADS},
        schedule::Trace,
        work_queues::Queue,
    },
    shader_file,
};

/// The pass's shader; `POWER`, `DEEP` and `ROTATING_FRAME` specialise it.
pub const MODULE: Module = Module {
    label: "shadow",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("types/work_queues.wgsl"),
        shader_file!("lib/numeric.wgsl"),
        shader_file!("lib/complex.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/sphere.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("formula/deep.wgsl"),
        shader_file!("formula/rotating_frame.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("lib/estimate_next.wgsl"),
        shader_file!("lib/over_relaxation.wgsl"),
        shader_file!("lib/shadow.wgsl"),
        shader_file!("pass/shadow.wgsl"),
    ],
};

/// Marches toward the lights of `trace` that surfaces block, each with two dispatches of its own.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let [shadow_cone, shadow] =
        [&recorder.passes.shadow_cone, &recorder.passes.shadow].map(Clone::clone);
    let rays = u64::from(trace.workgroups * WORKGROUP_THREADS);
    let (inputs, work_queues) = (recorder.inputs, &recorder.targets.work_queues);
    work_queues.clear_rays(&recorder.pipelines.gpu.queue);
    let marched = trace.lights & inputs.casting();
    let lights = inputs.lights_in_use().iter().filter(|light| (marched >> light.bit) & 1 != 0);
    // The first queue is the camera's.
    for (queue, light) in (1..).zip(lights) {
        let mut slice = recorder.slice(trace, grid);
        slice.ray_queue = queue;
        slice.light_bit = light.bit;
        slice.light_reach = light.shadow_reach;
        slice.light_vector = light.vector;
        slice.light_kind = light.kind;
        recorder.dispatch_queue(&shadow_cone, &work_queues.enqueue_rays, slice, Queue::HitBlocks);
        recorder.dispatch_queue(&shadow, &work_queues.reading, slice, Queue::Rays(queue));
        recorder.dispatches.queue += 1;
        recorder.dispatches.shadow += 1;
        recorder.dispatches.shadow_rays += rays;
    }
}
