//! The film's histogram.

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        post::{FIRST_LEVEL, Levels},
        uniforms::{Slice, Statistics},
    },
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "histogram",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/histogram.wgsl"),
    ],
};

/// Counts the film's pixels by luminance.
pub fn record(recorder: &mut Recorder<'_>) {
    // Writes take effect with the submit, before its passes.
    let first_bin = std::mem::offset_of!(Statistics, bins) as u64;
    let zeros = Statistics::zeroed().bins;
    recorder.pipelines.gpu.queue.write_buffer(
        &recorder.post.statistics,
        first_bin,
        bytemuck::bytes_of(&zeros),
    );
    let pipeline = recorder.pipelines.post().histogram.clone();
    let workgroups = Levels::of(&recorder.inputs.frame).workgroups(FIRST_LEVEL);
    recorder.dispatch(&pipeline, Slice::zeroed(), workgroups);
    recorder.dispatches.histogram += 1;
}
