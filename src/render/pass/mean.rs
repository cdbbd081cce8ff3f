//! The film's mean colour and its mean logarithm of luminance, by mip levels.

use super::reduce;
use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        post::{FIRST_LEVEL, Levels},
        uniforms::Slice,
    },
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "mean",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/mean.wgsl"),
    ],
};

/// Makes all mip levels of the film, down to one element.
pub fn record(recorder: &mut Recorder<'_>) {
    let levels = Levels::of(&recorder.inputs.frame);
    let pipeline = recorder.pipelines.post().mean.clone();
    recorder.dispatch(&pipeline, Slice::zeroed(), levels.workgroups(FIRST_LEVEL));
    reduce::record(recorder, levels.last());
    recorder.dispatches.mean += 1;
}
