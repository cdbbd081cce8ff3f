//! What the WGSL files of a formula have to declare.

use crate::gpu::shader::File;

/// The WGSL files of a kernel.
///
/// `types` declares `struct FormulaUniforms` with a member `fractal: Fractal`, which the functions take by
/// value, and other members that they read as `frame.formula`. The files in `files`
/// declare, with the types of `shaders/types/estimate.wgsl`:
///
/// ```wgsl
/// fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate
/// fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate
/// fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate
/// fn distance_estimate(fractal: Fractal, point: vec3f) -> f32
/// fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f
/// fn orbit_colors(fractal: Fractal, point: vec3f) -> OrbitColors
/// fn cone_direction() -> vec3f
/// ```
///
/// A march evaluates the quick estimate, and the careful estimate where the quick estimate's step is
/// negative; the step of `estimate` is never negative. `along` is the ray's direction; several rays that march as
/// one use `cone_direction` instead.
#[derive(Clone, Debug)]
pub struct KernelFiles {
    /// Declares the uniforms.
    pub types: File,
    /// The kernels; their header lines may name files of `shaders/`.
    pub files: Vec<File>,
}
