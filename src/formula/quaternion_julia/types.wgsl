// The uniforms of the quaternion Julia set's kernels. Host twin: `mod.rs`.

struct Fractal {
    // Real part first.
    constant: vec4f,
    // Fourth coordinate of the points that are drawn.
    slice: f32,
    // Squared escape radius.
    limit: f32,
    log2_bailout: f32,
    iterations: u32,
    // Longest step of a ray.
    max_step: f32,
}

// The formula's part of a frame's uniforms.
struct FormulaUniforms {
    fractal: Fractal,
}
