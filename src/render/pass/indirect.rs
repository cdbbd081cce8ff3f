//! Indirect light from what is around each sample on the screen, with its direct light, onto the
//! film. Marches nothing.

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        lattice::Grid,
        schedule::{Points, Trace},
    },
    shader_file,
};

/// The pass's shader.
pub const MODULE: Module = Module {
    label: "indirect",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/light.wgsl"),
        shader_file!("types/sample.wgsl"),
        shader_file!("types/film.wgsl"),
        shader_file!("types/direct.wgsl"),
        shader_file!("types/indirect.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("lib/shared_exponent.wgsl"),
        shader_file!("lib/noise.wgsl"),
        shader_file!("lib/environment_map.wgsl"),
        shader_file!("lib/shading.wgsl"),
        shader_file!("pass/indirect.wgsl"),
    ],
};

/// Gathers light for the samples of `trace`.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.pipelines.indirect().clone();
    let mut slice = recorder.slice(trace, grid);
    if let Points::Indirect(level) = trace.points {
        slice.neighbour_level = level;
    }
    recorder.bind_indirect(trace);
    recorder.dispatch_pixels(&pipeline, slice);
    recorder.dispatches.indirect += 1;
}
