//! Shadow rays: writes one visibility bit a light for each sample.

use crate::{
    gpu::shader::Module,
    render::{
        frame::Recorder,
        lattice::{Grid, WORKGROUP_THREADS},
        schedule::Trace,
        uniforms,
    },
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
        shader_file!("lib/pace.wgsl"),
        shader_file!("lib/bundle.wgsl"),
        shader_file!("pass/shadow.wgsl"),
    ],
};

/// Marches toward the lights of `trace`, as many to a dispatch as its loops allow.
pub fn record(recorder: &mut Recorder<'_>, trace: &Trace, grid: &Grid) {
    let pipeline = recorder.passes.shadow.clone();
    let at_once = uniforms::lights_per_dispatch(recorder.inputs.picture.fractal.iterations);
    for lights in portions(trace.lights, at_once) {
        let mut slice = recorder.slice(trace, grid);
        slice.lights = [lights as u32, (lights >> 32) as u32];
        recorder.dispatch(&pipeline, slice, trace.workgroups);
        recorder.dispatches.shadow += 1;
        recorder.dispatches.shadow_rays +=
            u64::from(trace.workgroups * WORKGROUP_THREADS) * u64::from(lights.count_ones());
    }
}

/// The bits of `lights`, at most `at_once` in each portion.
fn portions(mut lights: u64, at_once: u32) -> impl Iterator<Item = u64> {
    std::iter::from_fn(move || {
        let all = lights;
        for _ in 0..at_once {
            // Clears the lowest bit.
            lights &= lights.wrapping_sub(1);
        }
        (all != 0).then_some(all & !lights)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn portions_have_every_light_once() {
        for lights in [0, 1, 0b1011_0110, u64::MAX, 1 << 63, 0xf0f0_0000_1234_0001] {
            for at_once in [1, 2, 3, 64, 1000] {
                let all: Vec<u64> = portions(lights, at_once).collect();
                assert!(all.iter().all(|portion| (1..=at_once).contains(&portion.count_ones())));
                assert_eq!(
                    all.iter().fold(0, |sum, portion| sum + u128::from(*portion)),
                    u128::from(lights)
                );
                assert_eq!(all.len() as u32, lights.count_ones().div_ceil(at_once));
            }
        }
    }
}
