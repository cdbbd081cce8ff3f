//! Surface points to normals: reads each sample's depth, writes its normal.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, schedule::Trace, work_queues::Queue},
    shader_file,
};

/// The pass's shader; `POWER`, `DEEP`, `ROTATING_FRAME` and `NORMALS` specialise it.
pub const MODULE: Module = Module {
    label: "normal",
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
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("formula/deep.wgsl"),
        shader_file!("formula/rotating_frame.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("pass/normal.wgsl"),
    ],
};

/// Finds the normals of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.passes.normal.clone();
    let slice = recorder.slice(trace, grid);
    recorder.dispatch_queue(
        &pipeline,
        &recorder.targets.work_queues.reading,
        slice,
        Queue::HitPoints,
    );
    recorder.dispatches.normal += 1;
}
