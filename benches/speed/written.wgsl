// Three formulas as a person writes them in WGSL: what the kernels that the program makes of texts cost beside.
// uses: types/frame_uniforms

// The parameters, so that the compiler folds none of them.
@group(1) @binding(1) var<storage, read> given: array<vec4f>;

const MAX_STEPS = 100u;

// Scale, fold limit, inner radius, outer radius.
fn mandelbox(point: vec3f) -> f32 {
    let by = given[0];
    let inner = by.z * by.z;
    let outer = by.w * by.w;
    let limit = given[1].x;
    var z = point;
    var dr = 1.0;
    for (var n = 0u; n < MAX_STEPS && dot(z, z) <= limit; n++) {
        z = clamp(z, vec3f(-by.y), vec3f(by.y)) * 2.0 - z;
        let factor = clamp(outer / max(dot(z, z), 1e-30), 1.0, outer / inner);
        z = by.x * factor * z + point;
        dr = abs(by.x) * factor * dr + 1.0;
    }
    return length(z) / dr;
}

// Scale; then the columns of a rotation.
fn menger(point: vec3f) -> f32 {
    let scale = given[0].x;
    let turn = mat3x3f(given[2].xyz, given[3].xyz, given[4].xyz);
    let limit = given[1].x;
    let shift = scale - 1.0;
    var z = point;
    var dr = 1.0;
    for (var n = 0u; n < MAX_STEPS && dot(z, z) <= limit; n++) {
        z = abs(turn * z);
        if (z.x < z.y) { z = z.yxz; }
        if (z.x < z.z) { z = z.zyx; }
        if (z.y < z.z) { z = z.xzy; }
        z = scale * z - vec3f(shift, shift, 0.0);
        if (z.z > 0.5 * shift) { z.z -= shift; }
        dr *= scale;
    }
    let beside = abs(z) - 1.0;
    return (length(max(beside, vec3f(0.0))) + min(max(beside.x, max(beside.y, beside.z)), 0.0)) / dr;
}

// The slice; the constant is behind the limit.
fn quaternion_julia(point: vec3f) -> f32 {
    let limit = given[1].x;
    let c = given[2];
    var z = vec4f(point, given[0].x);
    var dr = 1.0;
    for (var n = 0u; n < MAX_STEPS && dot(z, z) <= limit; n++) {
        dr *= 2.0 * length(z);
        z = vec4f(z.x * z.x - dot(z.yzw, z.yzw), 2.0 * z.x * z.yzw) + c;
    }
    let r = length(z);
    return 0.5 * r * log(r) / max(dr, 1e-18);
}
