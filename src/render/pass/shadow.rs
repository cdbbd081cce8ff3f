//! Shadow rays: writes one visibility bit a light for each sample.

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        lattice::{Grid, WORKGROUP_THREADS},
        schedule::Trace,
    },
    shader_file,
};

/// The pass's shader; `POWER` specialises it.
pub const MODULE: Module = Module {
    label: "shadow",
    files: &[
        shader_file!("types/picture.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("lib/numeric.wgsl"),
        shader_file!("lib/complex.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/sphere.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("lib/pace.wgsl"),
        shader_file!("lib/bundle.wgsl"),
        shader_file!("pass/shadow.wgsl"),
    ],
};

/// Marches toward the lights of `trace` that surfaces block, one to a dispatch.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.passes.shadow.clone();
    let rays = u64::from(trace.workgroups * WORKGROUP_THREADS);
    let inputs = recorder.inputs;
    let marched = trace.lights & inputs.casting();
    for light in inputs.lights_in_use().iter().filter(|light| (marched >> light.bit) & 1 != 0) {
        let mut slice = recorder.slice(trace, grid);
        slice.light_bit = light.bit;
        slice.light_reach = light.shadow_reach;
        slice.light_vector = light.vector;
        slice.light_kind = light.kind;
        recorder.dispatch(&pipeline, slice, trace.workgroups);
        recorder.dispatches.shadow += 1;
        recorder.dispatches.shadow_rays += rays;
    }
}
