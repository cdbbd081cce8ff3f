//! Cones of shadow rays: queues the blocks of samples that face a light, and how far their rays are
//! clear. [`super::shadow`] dispatches it.

use crate::{gpu::shader::Module, shader_file};

/// The pass's shader; `POWER`, `DEEP` and `ROTATING_FRAME` specialise it.
pub const MODULE: Module = Module {
    label: "shadow_cone",
    files: &[
        shader_file!("types/frame_uniforms.wgsl"),
        shader_file!("types/slice.wgsl"),
        shader_file!("types/gbuffer.wgsl"),
        shader_file!("types/work_queues.wgsl"),
        shader_file!("types/enqueue.wgsl"),
        shader_file!("lib/numeric.wgsl"),
        shader_file!("lib/complex.wgsl"),
        shader_file!("lib/lattice.wgsl"),
        shader_file!("lib/eye.wgsl"),
        shader_file!("lib/camera.wgsl"),
        shader_file!("lib/octahedral.wgsl"),
        shader_file!("lib/sphere.wgsl"),
        shader_file!("formula/deep.wgsl"),
        shader_file!("formula/rotating_frame.wgsl"),
        shader_file!("formula/mandelbulb.wgsl"),
        shader_file!("lib/estimate_next.wgsl"),
        shader_file!("lib/bundle.wgsl"),
        shader_file!("lib/shadow.wgsl"),
        shader_file!("pass/shadow_cone.wgsl"),
    ],
};
