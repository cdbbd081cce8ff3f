// The quaternion Julia set: q <- q^2 + c. Host twin, with the equations: `mod.rs`.
// uses: types/estimate

// Derivatives are clamped to this so that the next step cannot overflow.
const MAX_DERIVATIVE = 1e34;
// Lower bound of derivatives and squared lengths, which vanish if an orbit meets the origin.
const MIN_DERIVATIVE = 1e-18;

// q^2, the real part first.
fn squared(q: vec4f) -> vec4f {
    return vec4f(q.x * q.x - dot(q.yzw, q.yzw), (q.x + q.x) * q.yzw);
}

// Half the derivative of q^2 in the direction v: (q v + v q) / 2.
fn half_pushed(q: vec4f, v: vec4f) -> vec4f {
    return vec4f(q.x * v.x - dot(q.yzw, v.yzw), q.x * v.yzw + v.x * q.yzw);
}

fn start(fractal: Fractal, point: vec3f) -> vec4f {
    return vec4f(point, fractal.slice);
}

fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    var q = start(fractal, point);
    var s = dot(q, q);
    var dr = 1.0;
    for (var n = 0u; n < fractal.iterations && s <= fractal.limit; n++) {
        dr = 2.0 * sqrt(s) * min(dr, MAX_DERIVATIVE);
        q = squared(q) + fractal.constant;
        s = dot(q, q);
    }
    if (s <= 1.0) { return Estimate(0.0, 0.0); }
    let distance = 0.25 * log(s) * sqrt(s) / max(dr, MIN_DERIVATIVE);
    return Estimate(distance, min(distance, fractal.max_step));
}

fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return estimate(fractal, point, along);
}

// Never called: the quick estimate is exact.
fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return Estimate(0.0, 0.0);
}

fn distance_estimate(fractal: Fractal, point: vec3f) -> f32 {
    return estimate(fractal, point, vec3f(0.0)).distance;
}

// The direction in which `distance_estimate` grows fastest, not normalised; 0 inside.
//     grad DE = ((ln r + 1) dr grad r - r ln r grad dr) / (2 dr^2),  grad r = J^T q / r
// The code stores the columns of J over dr, and grad dr over dr^2: both are of order one.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    var q = start(fractal, point);
    var s = dot(q, q);
    var x = vec4f(1.0, 0.0, 0.0, 0.0);
    var y = vec4f(0.0, 1.0, 0.0, 0.0);
    var z = vec4f(0.0, 0.0, 1.0, 0.0);
    var slope = vec3f(0.0);
    for (var n = 0u; n < fractal.iterations && s <= fractal.limit; n++) {
        let r = sqrt(max(s, MIN_DERIVATIVE));
        let toward = vec3f(dot(x, q), dot(y, q), dot(z, q));
        slope = (slope + toward / (r * r)) / (2.0 * r);
        x = half_pushed(q, x) / r;
        y = half_pushed(q, y) / r;
        z = half_pushed(q, z) / r;
        q = squared(q) + fractal.constant;
        s = dot(q, q);
    }
    if (s <= 1.0) { return vec3f(0.0); }
    let r = sqrt(s);
    let log_r = log(r);
    let toward = vec3f(dot(x, q), dot(y, q), dot(z, q));
    return (log_r + 1.0) / r * toward - r * log_r * slope;
}

fn orbit_colors(fractal: Fractal, point: vec3f) -> OrbitColors {
    var q = start(fractal, point);
    var s = dot(q, q);
    var traps = vec3f(4.0);
    var n = 0u;
    for (; n < fractal.iterations && s <= fractal.limit; n++) {
        q = squared(q) + fractal.constant;
        s = dot(q, q);
        traps = min(traps, vec3f(s, dot(q.xy, q.xy), q.z * q.z));
    }
    var smooth_iterations = f32(n);
    if (s > fractal.limit) {
        smooth_iterations -= log2(max(0.5 * log2(s) / fractal.log2_bailout, 1.0));
    }
    return OrbitColors(smooth_iterations, sqrt(traps));
}

// The direction that stands for all rays of a cone: zero, since steps do not depend on it.
fn cone_direction() -> vec3f {
    return vec3f(0.0);
}
