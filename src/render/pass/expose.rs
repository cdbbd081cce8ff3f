//! Auto exposure from the film's mean.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, post::Levels, uniforms::Slice},
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "expose",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/expose.wgsl"),
    ],
};

/// Moves exposure by `adapt`, above 0 to 1, toward its goal; `mean_is_new` where the mip levels
/// hold a mean that the statistics do not.
pub fn record(recorder: &mut Recorder<'_>, mean_is_new: bool, adapt: f32) {
    let pipeline = recorder.pipelines.post().expose.clone();
    let last = Levels::of(&recorder.inputs.frame).last();
    let mip_level = if mean_is_new { last } else { 0 };
    recorder.dispatch(&pipeline, Slice { mip_level, adapt, ..Slice::zeroed() }, 1);
}
