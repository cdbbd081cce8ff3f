// The Mandelbulb and its Julia form: distance estimate, smooth iteration count, orbit traps.
// Thesis Algorithm 1, with atan2(z, rho) for asin(z / r) and, for whole powers, complex powers
// instead of trigonometry:
//     rho = |x + iy|, u = (x + iy) / rho, w = rho + iz
//     z^n = (Re w^n Re u^n, Re w^n Im u^n, Im w^n)
// The fractal is passed by value and read from the picture once, outside all loops: some drivers
// read a buffer anew for every use, and marches that do take twice as long on lavapipe.

// The power this pipeline is specialised for, 2 to 16; 0 reads it from the picture.
override POWER: u32 = 0u;

// How much more than n |z|^(n - 1) a step may be taken to stretch along the parallels: at the
// poles it would stop every ray.
const SIDEWAYS_MAX = 10.0;

// z^n in parts, which its derivatives are made of too.
struct Turned {
    // The rotor u and |x + iy|.
    u: vec2f,
    rho: f32,
    // Their powers.
    un: vec2f,
    wn: vec2f,
    // n |z|^(n - 1): what the derivative is multiplied by.
    stretch: f32,
}

// On the polar axis the rotor's direction is taken as that of +x.
fn rotor(z: vec3f, rho: f32) -> vec2f {
    if (rho > 0.0) { return z.xy / rho; }
    return vec2f(1.0, 0.0);
}

// A whole power n.
fn turned_whole(z: vec3f, r: f32, n: u32) -> Turned {
    let rho = length(z.xy);
    let u = rotor(z, rho);
    let wn = complex_power(vec2f(rho, z.z), n);
    return Turned(u, rho, complex_power(u, n), wn, f32(n) * real_power(r, n - 1u));
}

// A real power n in polar coordinates.
fn turned_real(z: vec3f, r: f32, n: f32) -> Turned {
    let rho = length(z.xy);
    let u = rotor(z, rho);
    if (r == 0.0) { return Turned(u, rho, u, vec2f(0.0), 0.0); }
    let log2_r = accurate_log2(r);
    let latitude = cos_sin_turns(n * angle_turns(z.z, rho));
    let longitude = cos_sin_turns(n * angle_turns(z.y, z.x));
    let stretch = n * accurate_exp2((n - 1.0) * log2_r);
    return Turned(u, rho, longitude, accurate_exp2(n * log2_r) * latitude, stretch);
}

fn turned(fractal: Fractal, z: vec3f, r: f32) -> Turned {
    if (POWER != 0u) { return turned_whole(z, r, POWER); }
    if (fractal.integer_power != 0u) {
        return turned_whole(z, r, fractal.integer_power);
    }
    return turned_real(z, r, fractal.power);
}

fn triplex_power(fractal: Fractal, t: Turned) -> vec3f {
    return vec3f(t.wn.x * t.un, t.wn.y * fractal.z_sign);
}

// The stretch along the parallels, n Re w^n / rho: 1e-15 is near enough to the axis for the
// limit, and the quotient stays finite.
fn sideways_stretch(fractal: Fractal, t: Turned) -> f32 {
    return fractal.power * t.wn.x / max(t.rho, 1e-15);
}

struct OrbitStep {
    // z^n without the constant.
    power: vec3f,
    // n |z|^(n - 1): what the derivative is multiplied by.
    stretch: f32,
    // What the step stretches most, along parallels too: at least `stretch`.
    widest_stretch: f32,
}

fn orbit_step(fractal: Fractal, z: vec3f, r: f32) -> OrbitStep {
    let t = turned(fractal, z, r);
    let widest = clamp(abs(sideways_stretch(fractal, t)), t.stretch, SIDEWAYS_MAX * t.stretch);
    return OrbitStep(triplex_power(fractal, t), t.stretch, widest);
}

struct Reach {
    // Estimated distance to the set: 0.5 ln(r) r / dr. 0 where the orbit stays inside the unit
    // sphere or at the origin, where ln r < 0 says "inside".
    distance: f32,
    // How far a ray may go from here: dr is a scalar that knows nothing of the stretch along
    // parallels, so a step follows dg, which does, several times, and never passes `distance`.
    step: f32,
}

// How many times the estimate by dg a ray may step: `fractal::estimator::step_factor`.
fn step_factor(fractal: Fractal) -> f32 {
    return clamp(0.75 * fractal.power, 2.0, 6.0);
}

fn reach(fractal: Fractal, point: vec3f) -> Reach {
    let julia = fractal.julia != 0u;
    let constant = select(point, fractal.julia_constant, julia);
    let derivative_constant = select(1.0, 0.0, julia);
    let bailout = fractal.bailout;
    var z = point;
    var r = length(z);
    var dr = 1.0;
    var dg = 1.0;
    for (var i = 0u; i < fractal.iterations; i++) {
        if (r > bailout) { break; }
        let next = orbit_step(fractal, z, r);
        dr = min(next.stretch * dr + derivative_constant, fractal.derivative_max);
        dg = min(next.widest_stretch * dg + derivative_constant, fractal.derivative_max);
        z = next.power + constant;
        r = length(z);
    }
    if (r <= 1.0) { return Reach(0.0, 0.0); }
    let height = 0.5 * log(r) * r;
    let distance = height / max(dr, 1e-37);
    let step = step_factor(fractal) * height / max(dg, 1e-37);
    return Reach(distance, min(min(step, distance), fractal.max_step));
}

fn distance_estimate(fractal: Fractal, point: vec3f) -> f32 {
    return reach(fractal, point).distance;
}

// The Jacobian of z^n over `stretch`: a turn of the meridian's plane by n - 1 latitudes, of the
// parallels by n - 1 longitudes, and a further stretch along these.
fn turned_jacobian(fractal: Fractal, t: Turned, height: f32, inverse_r: f32) -> mat3x3f {
    // w^(n - 1) over its length.
    let unit = inverse_r / max(length(t.wn), 1e-20);
    let m = unit * complex_product(t.wn, vec2f(t.rho, -height));
    let sideways = clamp(sideways_stretch(fractal, t) / max(t.stretch, 1e-30), -1e6, 1e6);
    let parallel = sideways * vec2f(-t.un.y, t.un.x);
    let sign = fractal.z_sign;
    return mat3x3f(
        vec3f(m.x * t.u.x * t.un - t.u.y * parallel, sign * m.y * t.u.x),
        vec3f(m.x * t.u.y * t.un + t.u.x * parallel, sign * m.y * t.u.y),
        vec3f(-m.y * t.un, sign * m.x),
    );
}

// The direction in which `distance_estimate` grows fastest, of any length; 0 inside. Exact: the
// orbit's Jacobian and the gradient of dr are carried along (forward differentiation).
//     grad DE = ((ln r + 1) dr grad r - r ln r grad dr) / (2 dr^2),  grad r = J^T z / r
// J grows as dr does and grad dr as its square, past what an f32 holds: both are kept in units
// of dr, which leaves the direction alone.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    let julia = fractal.julia != 0u;
    let constant = select(point, fractal.julia_constant, julia);
    let n = fractal.power;
    var z = point;
    var r = length(z);
    // J / dr, grad dr / dr^2, and the constant's own derivative over dr.
    var jacobian = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    var slope = vec3f(0.0);
    var added = select(1.0, 0.0, julia);
    for (var i = 0u; i < fractal.iterations; i++) {
        if (r > fractal.bailout) { break; }
        let t = turned(fractal, z, r);
        // This dr over the next: infinite where a Julia orbit meets the origin.
        let shrink = 1.0 / max(t.stretch + added, 1e-9);
        let kept = t.stretch * shrink;
        let inverse_r = 1.0 / max(r, 1e-9);
        slope = (kept * shrink) * ((n - 1.0) * inverse_r * inverse_r * (z * jacobian) + slope);
        jacobian = kept * (turned_jacobian(fractal, t, z.z, inverse_r) * jacobian);
        added *= shrink;
        jacobian[0].x += added;
        jacobian[1].y += added;
        jacobian[2].z += added;
        z = triplex_power(fractal, t) + constant;
        r = length(z);
    }
    if (r <= 1.0) { return vec3f(0.0); }
    let log_r = log(r);
    return (log_r + 1.0) / r * (z * jacobian) - r * log_r * slope;
}

struct OrbitColors {
    // N - log_n(ln r / ln bailout): thesis eq. 3.1 for any power and bailout.
    smooth_iterations: f32,
    // Least distances of the orbit, after its start, from the origin, the z axis, the plane z = 0.
    traps: vec3f,
}

fn orbit_colors(fractal: Fractal, point: vec3f) -> OrbitColors {
    let constant = select(point, fractal.julia_constant, fractal.julia != 0u);
    var z = point;
    var r = length(z);
    var traps = vec3f(2.0);
    var count = 0u;
    for (; count < fractal.iterations; count++) {
        if (r > fractal.bailout) { break; }
        z = orbit_step(fractal, z, r).power + constant;
        r = length(z);
        traps = min(traps, vec3f(r, length(z.xy), abs(z.z)));
    }
    var smooth_iterations = f32(count);
    if (r > fractal.bailout) {
        smooth_iterations -= log2(max(log2(r) / fractal.log2_bailout, 1.0)) / log2(fractal.power);
    }
    return OrbitColors(smooth_iterations, traps);
}
