// The uniforms of kernels that are made from a formula's text. Host twin: `uniforms.rs`.

struct Fractal {
    julia_constant: vec4f,
    iterations: u32,
    // What `extent_test` may reach: the bailout or its square.
    limit: f32,
    log_bailout: f32,
    // Longest step of a ray.
    max_step: f32,
    // Step of a ray over the estimate.
    march: f32,
    // Derivative of the addend by the point: 1, or 0 in the Julia form.
    addend_derivative: f32,
    // Factor that brings orbit traps into the range of 2 that pictures store.
    trap_scale: f32,
    // The running derivative at the start.
    initial_derivative: f32,
    // 1 if orbits grow as a power, 0 if by a factor.
    is_power: f32,
    // 1 if the text gives the distance itself, whose sign then says what is inside.
    has_own_distance: u32,
}

// The formula's part of a frame's uniforms.
struct FormulaUniforms {
    fractal: Fractal,
}

// Values of the parameters, and what depends on parameters only, four to a vector. Where several formulas take
// turns, the sequence of steps comes first: see `sequence.rs`. The size comes from `operations.rs`.
struct FormulaTable {
    slots: array<vec4f, TABLE_VECTORS>,
}

@group(0) @binding(1) var<uniform> table: FormulaTable;
