//! Cones of camera rays: queues the blocks of samples that may hit, and how far their rays are clear.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, schedule::Trace},
    shader_file,
};

/// The pass's shader; `POWER`, `DEEP` and `ROTATING_FRAME` specialise it.
pub const MODULE: Module = Module {
    label: "camera_cone",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("types/work_queues.wgsl"),
        shader_file!("types/enqueue.wgsl"),
        shader_file!("lib/numeric.wgsl"),
        shader_file!("lib/complex.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/sphere.wgsl"),
        shader_file!("formula/deep.wgsl"),
        shader_file!("formula/rotating_frame.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("lib/estimate_next.wgsl"),
        shader_file!("lib/bundle.wgsl"),
        shader_file!("pass/camera_cone.wgsl"),
    ],
};

/// Sends out the bundles of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.passes.camera_cone.clone();
    let slice = recorder.slice(trace, grid);
    let work_queues = &recorder.targets.work_queues;
    work_queues.clear_rays(&recorder.pipelines.gpu.queue);
    recorder.dispatch_blocks(&pipeline, &work_queues.enqueue_rays, slice);
}
