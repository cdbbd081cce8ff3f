//! The film's mean colour and its mean logarithm of luminance, by mip levels.

use super::reduce;
use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        glow::{self, FIRST_LEVEL},
        uniforms::Slice,
    },
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "mean",
    files: &[
        shader_file!("types/picture.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/glow.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/mean.wgsl"),
    ],
};

/// Makes all mip levels of the film, down to one element.
pub fn record(recorder: &mut Recorder<'_>) {
    let size_px = recorder.inputs.picture.size_px;
    let pipeline = recorder.kernels.glow().mean.clone();
    recorder.dispatch(&pipeline, Slice::zeroed(), glow::workgroups(size_px, FIRST_LEVEL));
    reduce::record(recorder, glow::last_level(size_px));
    recorder.dispatches.mean += 1;
}
