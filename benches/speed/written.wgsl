// Three formulas as a person writes them in WGSL, for comparison with the kernels that the program makes of texts.
// Iterations are the frame's, as a view of some depth has them.
// uses: types/frame_uniforms

// The parameters, so that the compiler folds none of them.
@group(1) @binding(1) var<storage, read> params: array<vec4f>;

// Scale, fold limit, inner radius, outer radius.
fn mandelbox(point: vec3f) -> f32 {
    let settings = params[0];
    let inner = settings.z * settings.z;
    let outer = settings.w * settings.w;
    let limit = params[1].x;
    let iterations = frame_uniforms.formula.fractal.iterations;
    var z = point;
    var dr = 1.0;
    for (var n = 0u; n < iterations && dot(z, z) <= limit; n++) {
        z = clamp(z, vec3f(-settings.y), vec3f(settings.y)) * 2.0 - z;
        let factor = clamp(outer / max(dot(z, z), 1e-30), 1.0, outer / inner);
        z = settings.x * factor * z + point;
        dr = abs(settings.x) * factor * dr + 1.0;
    }
    return length(z) / dr;
}

// Scale; then the columns of a rotation.
fn menger(point: vec3f) -> f32 {
    let scale = params[0].x;
    let rotation = mat3x3f(params[2].xyz, params[3].xyz, params[4].xyz);
    let limit = params[1].x;
    let iterations = frame_uniforms.formula.fractal.iterations;
    let shift = scale - 1.0;
    var z = point;
    var dr = 1.0;
    for (var n = 0u; n < iterations && dot(z, z) <= limit; n++) {
        z = abs(rotation * z);
        if (z.x < z.y) { z = z.yxz; }
        if (z.x < z.z) { z = z.zyx; }
        if (z.y < z.z) { z = z.xzy; }
        z = scale * z - vec3f(shift, shift, 0.0);
        if (z.z > 0.5 * shift) { z.z -= shift; }
        dr *= scale;
    }
    let outside = abs(z) - 1.0;
    return (length(max(outside, vec3f(0.0))) + min(max(outside.x, max(outside.y, outside.z)), 0.0)) / dr;
}

// The slice; the constant is behind the limit.
fn quaternion_julia(point: vec3f) -> f32 {
    let limit = params[1].x;
    let iterations = frame_uniforms.formula.fractal.iterations;
    let c = params[2];
    var z = vec4f(point, params[0].x);
    var dr = 1.0;
    for (var n = 0u; n < iterations && dot(z, z) <= limit; n++) {
        dr *= 2.0 * length(z);
        z = vec4f(z.x * z.x - dot(z.yzw, z.yzw), 2.0 * z.x * z.yzw) + c;
    }
    let r = length(z);
    return 0.5 * r * log(r) / max(dr, 1e-18);
}
