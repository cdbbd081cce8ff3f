// The Mandelbulb and its Julia form: distance estimate, smooth iteration count, orbit traps.
// Thesis Algorithm 1, with atan2(z, rho) for asin(z / r) and, for whole powers, complex powers
// instead of trigonometry:
//     rho = |x + iy|, u = (x + iy) / rho, w = rho + iz
//     z^n = (Re w^n Re u^n, Re w^n Im u^n, Im w^n)

// The power this pipeline is specialised for, 2 to 16; 0 reads it from the picture.
override POWER: u32 = 0u;

// How much more than n |z|^(n - 1) a step may be taken to stretch along the parallels: at the
// poles it would stop every ray.
const SIDEWAYS_MAX = 10.0;

struct OrbitStep {
    // z^n without the constant.
    power: vec3f,
    // n |z|^(n - 1): what the derivative is multiplied by.
    stretch: f32,
    // What the step stretches most, along parallels too: at least `stretch`.
    widest_stretch: f32,
}

// `sideways`: n |Re w^n| / rho, the stretch along the parallels.
fn orbit_step_of(power: vec3f, stretch: f32, sideways: f32) -> OrbitStep {
    return OrbitStep(power, stretch, clamp(sideways, stretch, SIDEWAYS_MAX * stretch));
}

// A whole power n.
fn orbit_step_whole(z: vec3f, r: f32, n: u32) -> OrbitStep {
    let rho_squared = dot(z.xy, z.xy);
    let rho = sqrt(rho_squared);
    // On the polar axis the rotor's direction is taken as that of +x.
    var u = vec2f(1.0, 0.0);
    if (rho_squared > 0.0) { u = z.xy / rho; }
    let wn = complex_power(vec2f(rho, z.z), n);
    let un = complex_power(u, n);
    // 1e-15: near enough to the axis for the limit, and the quotient stays finite.
    let sideways = f32(n) * abs(wn.x) / max(rho, 1e-15);
    return orbit_step_of(vec3f(wn.x * un, wn.y), f32(n) * real_power(r, n - 1u), sideways);
}

// A real power n in polar coordinates.
fn orbit_step_real(z: vec3f, r: f32, n: f32) -> OrbitStep {
    if (r == 0.0) { return OrbitStep(vec3f(0.0), 0.0, 0.0); }
    let log2_r = accurate_log2(r);
    let rho = length(z.xy);
    let latitude = cos_sin_turns(n * angle_turns(z.z, rho));
    let longitude = cos_sin_turns(n * angle_turns(z.y, z.x));
    let rn = accurate_exp2(n * log2_r);
    let stretch = n * accurate_exp2((n - 1.0) * log2_r);
    let sideways = n * rn * abs(latitude.x) / max(rho, 1e-15);
    return orbit_step_of(rn * vec3f(latitude.x * longitude, latitude.y), stretch, sideways);
}

fn orbit_step(z: vec3f, r: f32) -> OrbitStep {
    var next: OrbitStep;
    if (POWER != 0u) {
        next = orbit_step_whole(z, r, POWER);
    } else if (picture.fractal.integer_power != 0u) {
        next = orbit_step_whole(z, r, picture.fractal.integer_power);
    } else {
        next = orbit_step_real(z, r, picture.fractal.power);
    }
    next.power.z *= picture.fractal.z_sign;
    return next;
}

struct Reach {
    // Estimated distance to the set: 0.5 ln(r) r / dr. 0 where the orbit stays inside the unit
    // sphere or at the origin, where ln r < 0 says "inside".
    distance: f32,
    // How far a ray may go from here: dr is a scalar that knows nothing of the stretch along
    // parallels, so a step follows dg, which does, doubled, and never passes `distance`.
    step: f32,
}

fn reach(point: vec3f) -> Reach {
    let julia = picture.fractal.julia != 0u;
    let constant = select(point, picture.fractal.julia_constant, julia);
    let derivative_constant = select(1.0, 0.0, julia);
    let bailout = picture.fractal.bailout;
    var z = point;
    var r = length(z);
    var dr = 1.0;
    var dg = 1.0;
    for (var i = 0u; i < picture.fractal.iterations; i++) {
        if (r > bailout) { break; }
        let next = orbit_step(z, r);
        dr = min(next.stretch * dr + derivative_constant, picture.fractal.derivative_max);
        dg = min(next.widest_stretch * dg + derivative_constant, picture.fractal.derivative_max);
        z = next.power + constant;
        r = length(z);
    }
    if (r <= 1.0) { return Reach(0.0, 0.0); }
    let height = 0.5 * log(r) * r;
    let distance = height / max(dr, 1e-37);
    return Reach(distance, min(min(2.0 * height / max(dg, 1e-37), distance), picture.fractal.max_step));
}

fn distance_estimate(point: vec3f) -> f32 {
    return reach(point).distance;
}

struct OrbitColors {
    // N - log_n(ln r / ln bailout): thesis eq. 3.1 for any power and bailout.
    smooth_iterations: f32,
    // Least distances of the orbit, after its start, from the origin, the z axis, the plane z = 0.
    traps: vec3f,
}

fn orbit_colors(point: vec3f) -> OrbitColors {
    let constant = select(point, picture.fractal.julia_constant, picture.fractal.julia != 0u);
    var z = point;
    var r = length(z);
    var traps = vec3f(2.0);
    var count = 0u;
    for (; count < picture.fractal.iterations; count++) {
        if (r > picture.fractal.bailout) { break; }
        z = orbit_step(z, r).power + constant;
        r = length(z);
        traps = min(traps, vec3f(r, length(z.xy), abs(z.z)));
    }
    var smooth_iterations = f32(count);
    if (r > picture.fractal.bailout) {
        smooth_iterations -= log2(max(log2(r) / picture.fractal.log2_bailout, 1.0)) / log2(picture.fractal.power);
    }
    return OrbitColors(smooth_iterations, traps);
}
