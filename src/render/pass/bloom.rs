//! The light that blooms: what is above the threshold, brought to a mip level and blurred there.

use super::{blur, reduce};
use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        post::{FIRST_LEVEL, Kernel, Levels},
        uniforms::Slice,
    },
    shader_file,
};
use bytemuck::Zeroable;

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "bloom",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/post.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/luminance.wgsl"),
        shader_file!("lib/mip.wgsl"),
        shader_file!("lib/curve.wgsl"),
        shader_file!("lib/exposure.wgsl"),
        shader_file!("pass/bloom.wgsl"),
    ],
};

/// Leaves the blurred light in the mip level that the statistics then name.
pub fn record(recorder: &mut Recorder<'_>) {
    let picture = &recorder.inputs.frame;
    let levels = Levels::of(picture);
    let passes = picture.bloom.passes;
    let kernel = Kernel::new(picture.bloom.radius, passes, levels);
    let pipeline = recorder.pipelines.post().bloom.clone();
    recorder.dispatch(&pipeline, Slice::zeroed(), levels.workgroups(FIRST_LEVEL));
    reduce::record(recorder, kernel.level);
    for _ in 0..passes {
        blur::record(recorder, kernel);
    }
    recorder.dispatches.bloom += 1;
}
