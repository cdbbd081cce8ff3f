//! Light and colour of each sample, onto the film, or to where indirect light is made of it.
//! Marches nothing.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, schedule::Trace},
    shader_file,
};

/// The pass's shader; `HAS_ENVIRONMENT_MAP` and `SINGLE` specialise it.
pub const MODULE: Module = Module {
    label: "shade",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/light.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("types/direct.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("lib/shared_exponent.wgsl"),
        shader_file!("lib/environment_map.wgsl"),
        shader_file!("lib/shading.wgsl"),
        shader_file!("pass/shade.wgsl"),
    ],
};

/// Shades the samples of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let slice = recorder.slice(trace, grid);
    let passes = recorder.passes;
    let pipeline = if slice.samples == 1 { &passes.shade } else { &passes.shade_together }.clone();
    recorder.bind_film();
    recorder.bind_environment();
    recorder.dispatch_pixels(&pipeline, slice);
    recorder.dispatches.shade += 1;
}
