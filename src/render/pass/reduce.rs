//! Mip levels from the finest one.

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
    label: "reduce",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("pass/reduce.wgsl"),
    ],
};

/// Makes every level up to `last`.
pub fn record(recorder: &mut Recorder<'_>, last: u32) {
    let pipeline = recorder.pipelines.post().reduce.clone();
    for level in FIRST_LEVEL..last {
        let workgroups = Levels::of(&recorder.inputs.frame).workgroups(level + 1);
        let slice = Slice { mip_level: level, ..Slice::zeroed() };
        recorder.dispatch(&pipeline, slice, workgroups);
    }
}
