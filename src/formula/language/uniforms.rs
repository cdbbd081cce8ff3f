//! What the kernels of a formula's text read of a frame. WGSL twin: `types.wgsl`.

use crate::gpu::host_shared::host_shared;

host_shared! {
    /// Name, size in bytes and fields of every struct here.
    HOST_SHARED;
    /// The set as in `types.wgsl`, where its name is `Fractal`.
    Uniforms {
        /// The addend of the Julia form.
        julia_constant: [f32; 4],
        /// Most orbit steps.
        iterations: u32,
        /// What an orbit's extent, or its square, may reach.
        limit: f32,
        /// Natural logarithm of the bailout.
        log_bailout: f32,
        /// Longest step of a ray.
        max_step: f32,
        /// Step of a ray over the estimate.
        march: f32,
        /// Derivative of the addend by the point.
        addend_derivative: f32,
        /// Factor of orbit traps: large sets have larger ones than a picture stores.
        trap_scale: f32,
        /// The running derivative at the start.
        initial_derivative: f32,
        /// 1 if orbits grow as a power, 0 if by a factor.
        is_power: f32,
        /// 1 if the text gives the distance itself, whose sign then says what is inside.
        has_own_distance: u32,
    }
}

/// Number of parameter values, and values computed from them, that a formula's table holds.
pub const MAX_SLOTS: usize = 1024;
