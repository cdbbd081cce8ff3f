//! Shadow rays: writes one visibility bit a light for each sample.

use crate::{
    gpu::shader::Module,
    render::{frame::Recorder, lattice::Grid, schedule::Trace, uniforms},
    shader_file,
};

/// The pass's shader; `POWER` specialises it.
pub const MODULE: Module = Module {
    label: "shadow",
    files: &[
        shader_file!("types/picture.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/light.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("lib/numeric.wgsl"),
        shader_file!("lib/complex.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/sphere.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("pass/shadow.wgsl"),
    ],
};

/// Marches toward every light, as many to a dispatch as its loops allow. Without any light one
/// dispatch still clears the bits.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.marchers.shadow.clone();
    let picture = &recorder.inputs.picture;
    let lights = picture.surface.light_count;
    let at_once = uniforms::lights_per_dispatch(picture.fractal.iterations);
    let mut first = 0;
    loop {
        let mut slice = recorder.slice(trace, grid);
        slice.first_light = first;
        slice.light_count = at_once.min(lights - first);
        recorder.dispatch(&pipeline, slice, trace.workgroups);
        recorder.dispatches.shadow += 1;
        first += at_once;
        if first >= lights {
            break;
        }
    }
}
