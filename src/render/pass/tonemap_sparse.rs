//! The samples of a sparse lattice to display values.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid},
    shader_file,
};

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "tonemap_sparse",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/tonemap_sparse.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/curve.wgsl"),
        shader_file!("lib/noise.wgsl"),
        shader_file!("lib/srgb.wgsl"),
        shader_file!("pass/tonemap_sparse.wgsl"),
    ],
};

/// How many samples a lattice level's rows have room for.
pub fn places(level: u32, size_px: [u32; 2]) -> u64 {
    let [columns, rows] = size_px.map(|side| u64::from(side.div_ceil(1 << (level / 2))));
    columns * rows
}

/// Develops every sample of a lattice level.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let pipeline = recorder.pipelines.tonemap_sparse();
    let grid = Grid::level(level, recorder.inputs.frame.size_px);
    recorder.dispatch_grid(&pipeline, &grid, 1 << (level / 2));
}
