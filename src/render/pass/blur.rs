//! A uniform kernel over a mip level, one direction after the other (thesis 4.5, "Bloom").

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        post::{Kernel, Levels},
        uniforms::Slice,
    },
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "blur",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/blur.wgsl"),
    ],
};

/// Applies `kernel` once.
pub fn record(recorder: &mut Recorder<'_>, kernel: Kernel) {
    let pipeline = recorder.pipelines.post().blur.clone();
    let workgroups = Levels::of(&recorder.inputs.frame).workgroups(kernel.level);
    for axis in 0..2 {
        let Kernel { level, half_width } = kernel;
        let slice = Slice { mip_level: level, axis, half_width, ..Slice::zeroed() };
        recorder.dispatch(&pipeline, slice, workgroups);
    }
}
