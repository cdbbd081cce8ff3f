//! Fills the film between the pixels of a sparse lattice, along edges.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid},
    shader_file,
};

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "fill",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("pass/fill.wgsl"),
    ],
};

/// Fills every level below `level`, the coarsest first: each reads what the one before wrote.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let pipeline = recorder.pipelines.fill();
    for finer in (0..level).rev() {
        let grid = Grid::added(finer, recorder.inputs.frame.size_px);
        if grid.workgroups() > 0 {
            recorder.dispatch_grid(&pipeline, &grid, 1 << (finer / 2));
            recorder.dispatches.fill += 1;
        }
    }
}
