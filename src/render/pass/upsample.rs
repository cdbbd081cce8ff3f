//! Developed samples of a sparse lattice to the display picture.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid},
    shader_file,
};

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "upsample",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/tonemap_sparse.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/noise.wgsl"),
        shader_file!("lib/srgb.wgsl"),
        shader_file!("pass/upsample.wgsl"),
    ],
};

/// Makes the whole region's display picture of a lattice level that has been developed.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let pipeline = recorder.pipelines.upsample();
    let slice = Grid::level(level, recorder.inputs.frame.size_px).slice(0);
    recorder.dispatch_plane(&pipeline, slice);
    recorder.dispatches.fill += 1;
    recorder.dispatches.tone += 1;
}
