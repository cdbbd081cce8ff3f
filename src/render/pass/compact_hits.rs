//! Queues the blocks of samples that have surface points.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, schedule::Trace},
    shader_file,
};

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "compact_hits",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("types/work_queues.wgsl"),
        shader_file!("types/enqueue.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("pass/compact_hits.wgsl"),
    ],
};

/// Queues the surface points of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipelines.compact_hits();
    let slice = recorder.slice(trace, grid);
    let work_queues = &recorder.targets.work_queues;
    work_queues.clear_hits(&recorder.pipelines.gpu.queue);
    recorder.dispatch_blocks(&pipeline, &work_queues.enqueue_hits, slice);
}
