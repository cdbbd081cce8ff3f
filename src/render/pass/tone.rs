//! Film to display: exposure, tone curve, bloom, sRGB, dither.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, uniforms::Slice},
    shader_file,
};

/// The pass's shader; `CURVE`, `BLOOM`, `ANAGLYPH` and `SPARSE` specialise it.
pub const MODULE: Module = Module {
    label: "tone",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("lib/curve.wgsl"),
        shader_file!("lib/exposure.wgsl"),
        shader_file!("lib/noise.wgsl"),
        shader_file!("lib/srgb.wgsl"),
        shader_file!("pass/tone.wgsl"),
    ],
};

/// Makes the whole region's display picture of a film whose finest complete lattice is `level`.
pub fn record(recorder: &mut Recorder<'_>, level: u32) {
    let passes = recorder.passes;
    let pipeline = if level == 0 { &passes.tone } else { &passes.sparse_tone };
    let spacing = if level == 0 { 0 } else { 1 << (level / 2) };
    let whole = Grid::level(0, recorder.inputs.frame.size_px);
    recorder.dispatch_plane(pipeline, Slice { spacing, ..whole.slice(0) });
    recorder.dispatches.tone += 1;
}
