// The Mandelbulb and its Julia form: distance estimate, smooth iteration count, orbit traps.
// Thesis Algorithm 1, with atan2(z, rho) for asin(z / r) and, for whole powers, complex powers
// instead of trigonometry:
//     rho = |x + iy|, u = (x + iy) / rho, w = rho + iz
//     z^n = (Re w^n Re u^n, Re w^n Im u^n, Im w^n)
// Roots and divisions cost most, so they come late or not at all: u² and w² need only a = rho²,
// and an even power of w is p + i q rho with polynomials p and q of a and z:
//     n = 2 m:      Re w^n = p,             Im w^n = q rho
//     n = 2 m + 1:  Re w^n = (p - z q) rho, Im w^n = a q + z p
// The fractal is passed by value and read from the picture once, outside all loops: some drivers
// read a buffer anew for every use, and marches that do take twice as long on lavapipe.

// The power this pipeline is specialised for, 2 to 16; 0 reads it from the picture.
override POWER: u32 = 0u;

// Orbits run this far beside the polar axis, on which there is no longitude: toward +x, as
// atan2(0, 0) = 0 has it, and off the plane y = 0, in which a step could still meet the axis.
const BESIDE_AXIS = vec3f(1e-9, 1e-16, 0.0);

// How much more than n |z|^(n - 1) a step may be taken to stretch along the parallels: at the
// poles it would stop every ray.
const SIDEWAYS_MAX = 10.0;
// The same of the Jacobian in deep views, most of which are nowhere near the poles: with 10, rays passed
// lips that they should meet.
const DEEP_SIDEWAYS_MAX = 30.0;

// The squares that a step begins with.
struct Squares {
    // x² - y² + 2 i x y.
    xy: vec2f,
    // rho² = x² + y².
    a: f32,
    zz: f32,
    // |z|².
    s: f32,
}

fn squares(z: vec3f) -> Squares {
    let xx = z.x * z.x;
    let yy = z.y * z.y;
    let zz = z.z * z.z;
    let a = xx + yy;
    return Squares(vec2f(xx - yy, (z.x + z.x) * z.y), a, zz, a + zz);
}

// rho: of a deep view's points its square may be too small for an f32.
fn rho_of(z: vec3f, q: Squares) -> f32 {
    if (DEEP) { return max(length_of(z.xy), 1e-37); }
    return sqrt(q.a);
}

// z^n and what its derivatives are made of. What a caller leaves unused is not computed.
struct Raised {
    power: vec3f,
    // n |z|^(n - 1): what the derivative is multiplied by.
    stretch: f32,
    // One over the distance from the polar axis, rho.
    inverse_rho: f32,
    // Powers of the rotor u and of w.
    un: vec2f,
    wn: vec2f,
}

// u^2m. The division waits while (x + iy)^4 is made; a higher power would underflow near the axis.
fn rotor_power(q: Squares, inverse_a: f32, m: u32) -> vec2f {
    if (m % 2u == 0u) {
        return complex_power(inverse_a * (inverse_a * complex_square(q.xy)), m / 2u);
    }
    return complex_power(inverse_a * q.xy, m);
}

// n |z|^(n - 1) of that power.
fn stretch_whole(fractal: Fractal, q: Squares) -> f32 {
    if (POWER % 2u == 0u) { return (fractal.power * sqrt(q.s)) * real_power(q.s, POWER / 2u - 1u); }
    return fractal.power * real_power(q.s, POWER / 2u);
}

// The whole power that the pipeline is specialised for.
fn raised_whole(fractal: Fractal, z: vec3f, q: Squares) -> Raised {
    let m = POWER / 2u;
    let inverse_a = 1.0 / q.a;
    let rho = sqrt(q.a);
    let inverse_rho = rho * inverse_a;
    let even_u = rotor_power(q, inverse_a, m);
    let even_w = rooted_power(q.a, vec2f(q.a - q.zz, z.z + z.z), m);
    if (POWER % 2u == 0u) {
        let wn = vec2f(even_w.x, even_w.y * rho);
        let power = vec3f(wn.x * even_u, wn.y * fractal.z_sign);
        return Raised(power, stretch_whole(fractal, q), inverse_rho, even_u, wn);
    }
    let across = even_w.x - z.z * even_w.y;
    let along = q.a * even_w.y + z.z * even_w.x;
    let power = vec3f(complex_product(even_u, across * z.xy), along * fractal.z_sign);
    let un = inverse_rho * complex_product(even_u, z.xy);
    return Raised(power, stretch_whole(fractal, q), inverse_rho, un, vec2f(across * rho, along));
}

// A real power in polar coordinates.
fn raised_real(fractal: Fractal, z: vec3f, q: Squares) -> Raised {
    let n = fractal.power;
    let rho = sqrt(q.a);
    let r = sqrt(q.s);
    let latitude = cos_sin_turns(n * angle_turns(z.z, rho));
    let un = cos_sin_turns(n * angle_turns(z.y, z.x));
    let shrunk = accurate_exp2(0.5 * (n - 1.0) * accurate_log2(q.s));
    let wn = (r * shrunk) * latitude;
    let power = vec3f(wn.x * un, wn.y * fractal.z_sign);
    return Raised(power, n * shrunk, 1.0 / rho, un, wn);
}

// The stretch along the parallels: n Re w^n / rho, at most so many times the other.
fn sideways(fractal: Fractal, step: Raised, most: f32) -> f32 {
    let limit = most * step.stretch;
    return clamp(fractal.power * step.inverse_rho * step.wn.x, -limit, limit);
}

fn raised(fractal: Fractal, z: vec3f, q: Squares) -> Raised {
    if (POWER != 0u) { return raised_whole(fractal, z, q); }
    return raised_real(fractal, z, q);
}

// Where an orbit starts and what its steps add.
struct Orbit {
    start: vec3f,
    constant: vec3f,
    // Of deep views: what each step adds to the difference.
    added: vec3f,
    // The constant's own derivative: the Julia form's does not move with the point.
    constant_derivative: f32,
    // The point's own.
    start_derivative: f32,
    // The bailout's square.
    limit: f32,
}

fn orbit_of(fractal: Fractal, point: vec3f) -> Orbit {
    let julia = fractal.julia != 0u;
    let limit = fractal.bailout * fractal.bailout;
    if (DEEP) {
        let offset = fractal.scale * point;
        return Orbit(
            fractal.anchor + offset,
            select(fractal.anchor, fractal.julia_constant, julia),
            select(offset, vec3f(0.0), julia),
            select(fractal.scale, 0.0, julia),
            fractal.scale,
            limit,
        );
    }
    return Orbit(
        point + BESIDE_AXIS,
        select(point, fractal.julia_constant, julia) + BESIDE_AXIS,
        vec3f(0.0),
        select(1.0, 0.0, julia),
        1.0,
        limit,
    );
}

// The orbit at its beginning.
fn initial_state(orbit: Orbit, point: vec3f) -> OrbitState {
    return OrbitState(orbit.start, 0u, orbit.start_derivative * point, 0u);
}

fn has_ended(fractal: Fractal, orbit: Orbit, state: OrbitState, q: Squares) -> bool {
    return (q.s > orbit.limit) | (state.count >= fractal.iterations);
}

// Goes on from z^n.
fn step_on(state: OrbitState, power: vec3f, orbit: Orbit) -> OrbitState {
    if (DEEP) { return step_anew(state, power, orbit); }
    return OrbitState(power + orbit.constant, state.count + 1u, state.difference, state.index);
}

struct Estimate {
    // Estimated distance to the set: 0.5 ln(r) r / dr. 0 where the orbit stays inside the unit
    // sphere or at the origin, where ln r < 0 says "inside".
    distance: f32,
    // How far a ray may go from here: dr is a scalar that knows nothing of the stretch along
    // parallels, so a step follows dg, which does, several times, and never passes `distance`.
    step: f32,
}

// How many times the estimate by dg a ray may step: `fractal::estimator::step_factor`.
fn step_factor(fractal: Fractal) -> f32 {
    return clamp(0.75 * fractal.power, 3.0, 6.0);
}

// True if the estimate has false minima thinner than a pixel: `fractal::Estimator::needs_hit_check`.
fn needs_hit_check(fractal: Fractal) -> bool {
    if (POWER != 0u) { return POWER < 4u; }
    return fractal.power < 4.0;
}

// Derivatives of an orbit by its point.
struct Derivatives {
    dr: f32,
    // Product of bounds on the stretch, in units of the step factor: a ray's step is the height over the
    // larger of dr and dg. Over the many steps of a deep orbit it grows far past the Jacobian's norm; with
    // `FOLLOWS_DIRECTION` it bounds the stretch of other directions since the series approximation.
    dg: f32,
    // Jacobian times the ray's own direction, with `FOLLOWS_DIRECTION`.
    stretched: vec3f,
    // Stretch of the series approximation across its widest direction, over dr: 1/3 to 1/100 of the
    // widest at 1e-20.
    rest: f32,
}

fn initial_derivatives(fractal: Fractal, orbit: Orbit, along: vec3f) -> Derivatives {
    let one = orbit.start_derivative;
    let dg = select(one / step_factor(fractal), 0.0, FOLLOWS_DIRECTION);
    return Derivatives(one, dg, one * along, 1.0);
}

// Derivatives behind a step. `along`: the ray's direction, a unit vector.
fn next_derivatives(
    fractal: Fractal, orbit: Orbit, along: vec3f, before: Derivatives, step: Raised, z: vec3f, q: Squares,
) -> Derivatives {
    // Cut off before the step: the last step of an orbit may multiply by 1e19.
    let dr = step.stretch * min(before.dr, fractal.derivative_max) + orbit.constant_derivative;
    let widest = max(abs(sideways(fractal, step, SIDEWAYS_MAX)), step.stretch);
    let dg = widest * min(before.dg, fractal.derivative_max);
    if (!FOLLOWS_DIRECTION) {
        let added = orbit.constant_derivative / step_factor(fractal);
        return Derivatives(dr, dg + added, before.stretched, 0.0);
    }
    let stretched = pushed(fractal, step, z, q, before.stretched) + orbit.constant_derivative * along;
    return Derivatives(dr, dg, stretched, before.rest);
}

// A ray's safe step. `height`: see `height_of`.
fn safe_step(derivatives: Derivatives, height: f32) -> f32 {
    if (!FOLLOWS_DIRECTION) { return height / max(max(derivatives.dg, derivatives.dr), 1e-37); }
    // The square of `stretched` can overflow with a large bailout.
    let inverse = 1.0 / max(derivatives.dr, 1e-37);
    let followed = inverse * derivatives.stretched;
    let rest = max(derivatives.rest, inverse * derivatives.dg);
    let norm = max(max(length(followed), rest), 1.0);
    return inverse * height / norm;
}

// Estimate at a point, exact everywhere. `along`: the ray's direction, a unit vector.
// Perturbed and plain steps have loops of their own: lanes that disagree on a branch compute both sides.
fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    if (ROTATING_FRAME) { return rotating_estimate(fractal, point); }
    let orbit = orbit_of(fractal, point);
    var state = initial_state(orbit, point);
    var derivatives = initial_derivatives(fractal, orbit, along);
    if (DEEP) {
        let which = series_of(point);
        for (; which < SERIES; ) {
            state = far_state(which, point);
            derivatives = series_derivatives(fractal, anchor_orbit.series[which], point, along, which);
            break;
        }
    }
    var q = squares(state.z);
    for (; ; ) {
        for (; DEEP; ) {
            if (has_ended(fractal, orbit, state, q) || !is_close(state, q)) { break; }
            let step = raised_next(fractal, state, q);
            derivatives = next_derivatives(fractal, orbit, along, derivatives, step, state.z, q);
            state = step_close(state, step, orbit);
            q = squares(state.z);
        }
        for (; ; ) {
            if (has_ended(fractal, orbit, state, q) || (DEEP && is_close(state, q))) { break; }
            let step = raised(fractal, state.z, q);
            derivatives = next_derivatives(fractal, orbit, along, derivatives, step, state.z, q);
            state = step_on(state, step.power, orbit);
            q = squares(state.z);
        }
        if (!DEEP || has_ended(fractal, orbit, state, q)) { break; }
    }
    return estimate_at(fractal, derivatives, q);
}

// 0.5 ln(r) r: the distance estimate times dr.
fn height_of(q: Squares) -> f32 {
    return 0.25 * log(q.s) * sqrt(q.s);
}

// Estimate at an orbit's end.
fn estimate_at(fractal: Fractal, derivatives: Derivatives, q: Squares) -> Estimate {
    if (q.s <= 1.0) { return Estimate(0.0, 0.0); }
    let height = height_of(q);
    let distance = height / max(derivatives.dr, 1e-37);
    return Estimate(distance, min(safe_step(derivatives, height), fractal.max_step));
}

// The near step from `frame.near[index]`, unless the orbit has escaped.
fn near_step(
    index: u32, state: ptr<function, OrbitState>, derivatives: ptr<function, Derivatives>,
    fractal: Fractal, orbit: Orbit, along: vec3f,
) {
    let q = squares((*state).z);
    // No orbit has escaped before the first: it starts in the bounding sphere, or behind the series.
    if (index > 0u && q.s > orbit.limit) { return; }
    let step = raised_close(fractal, *state, frame.near[index], sqrt(q.a), q);
    *derivatives = next_derivatives(fractal, orbit, along, *derivatives, step, (*state).z, q);
    *state = step_to(*state, frame.near[index + 1u].z, step, orbit);
}

// The same by the near steps, or by plain ones far from the anchor. Where neither is exact enough the step
// is negative, and the caller needs `estimate`: outside the radius of the near steps, and on orbits whose
// dr falls below `least_derivative` behind them.
fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    if (!DEEP || ROTATING_FRAME) { return estimate(fractal, point, along); }
    let orbit = orbit_of(fractal, point);
    var state = initial_state(orbit, point);
    var derivatives = initial_derivatives(fractal, orbit, along);
    if (HAS_SERIES) {
        state = series_state(frame.series, frame.near[0].z, point);
        derivatives = series_derivatives(fractal, frame.series, point, along, 0u);
    }
    // Unrolled by hand: llvmpipe keeps a loop of four or more, which takes twice as long.
    near_step(0u, &state, &derivatives, fractal, orbit, along);
    if (NEAR_STEPS > 1u) { near_step(1u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 2u) { near_step(2u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 3u) { near_step(3u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 4u) { near_step(4u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 5u) { near_step(5u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 6u) { near_step(6u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 7u) { near_step(7u, &state, &derivatives, fractal, orbit, along); }
    var q = squares(state.z);
    var is_quick = is_near(point);
    var least = fractal.least_derivative / max(0.5 * length(point), 1.0);
    if (HAS_SERIES && is_far(point)) {
        is_quick = true;
        least = 0.0;
        state.z = orbit.start + BESIDE_AXIS;
        state.count = 0u;
        derivatives = initial_derivatives(fractal, orbit, along);
        q = squares(state.z);
    }
    let constant = orbit.constant + orbit.added;
    for (; ; ) {
        if (!is_quick || has_ended(fractal, orbit, state, q) || derivatives.dr < least) { break; }
        let step = raised(fractal, state.z, q);
        derivatives = next_derivatives(fractal, orbit, along, derivatives, step, state.z, q);
        state.z = step.power + constant;
        state.count += 1u;
        q = squares(state.z);
    }
    if (!is_quick || derivatives.dr < least) { return Estimate(0.0, -1.0); }
    return estimate_at(fractal, derivatives, q);
}

fn distance_estimate(fractal: Fractal, point: vec3f) -> f32 {
    return estimate(fractal, point, vec3f(0.0)).distance;
}

fn scaled_identity(scale: f32) -> mat3x3f {
    return mat3x3f(scale, 0.0, 0.0, 0.0, scale, 0.0, 0.0, 0.0, scale);
}

// The Jacobian of z^n: n |z|^(n - 1) times a turn of the meridian's plane by n - 1 latitudes, of the
// parallels by n - 1 longitudes, and another stretch along these, at most so many times the first.
// n |z|^(n - 1) w^(n - 1) over its length is n w^n conj(w) / |z|^2.
fn raised_jacobian(
    fractal: Fractal, step: Raised, z: vec3f, q: Squares, sideways_max: f32,
) -> mat3x3f {
    let rho = rho_of(z, q);
    let u = z.xy / rho;
    let m = (fractal.power / max(q.s, 1e-18)) * complex_product(step.wn, vec2f(rho, -z.z));
    let parallel = sideways(fractal, step, sideways_max) * vec2f(-step.un.y, step.un.x);
    let sign = fractal.z_sign;
    return mat3x3f(
        vec3f(m.x * u.x * step.un - u.y * parallel, sign * m.y * u.x),
        vec3f(m.x * u.y * step.un + u.x * parallel, sign * m.y * u.y),
        vec3f(-m.y * step.un, sign * m.x),
    );
}

// How an orbit and its derivative change with the point.
struct Tangent {
    // The orbit's Jacobian over dr.
    jacobian: mat3x3f,
    // The gradient of dr over dr^2.
    slope: vec3f,
    // The constant's own derivative over dr.
    added: f32,
}

// A tangent after another step.
fn turned(fractal: Fractal, before: Tangent, step: Raised, z: vec3f, q: Squares) -> Tangent {
    // This dr over the next: infinite where a Julia orbit meets the origin.
    let shrink = 1.0 / max(step.stretch + before.added, 1e-9);
    let kept = step.stretch * shrink;
    let added = before.added * shrink;
    let along = (fractal.power - 1.0) / max(q.s, 1e-18) * (z * before.jacobian);
    let turn = raised_jacobian(fractal, step, z, q, 1e6);
    let jacobian = shrink * (turn * before.jacobian) + scaled_identity(added);
    return Tangent(jacobian, (kept * shrink) * (along + before.slope), added);
}

// The direction in which `distance_estimate` grows fastest, of any length; 0 inside. Exact: the
// orbit's Jacobian and the gradient of dr are carried along (forward differentiation).
//     grad DE = ((ln r + 1) dr grad r - r ln r grad dr) / (2 dr^2),  grad r = J^T z / r
// J grows as dr does and grad dr as its square, past what an f32 holds: both are kept in units
// of dr, which leaves the direction alone.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    if (ROTATING_FRAME) { return rotating_gradient(fractal, point); }
    let orbit = orbit_of(fractal, point);
    var state = initial_state(orbit, point);
    let added = orbit.constant_derivative / orbit.start_derivative;
    var tangent = Tangent(scaled_identity(1.0), vec3f(0.0), added);
    if (DEEP) {
        let which = series_of(point);
        for (; which < SERIES; ) {
            state = far_state(which, point);
            tangent = series_tangent(anchor_orbit.series[which], orbit, point);
            break;
        }
    }
    var q = squares(state.z);
    for (; ; ) {
        for (; DEEP; ) {
            if (has_ended(fractal, orbit, state, q) || !is_close(state, q)) { break; }
            let step = raised_next(fractal, state, q);
            tangent = turned(fractal, tangent, step, state.z, q);
            state = step_close(state, step, orbit);
            q = squares(state.z);
        }
        for (; ; ) {
            if (has_ended(fractal, orbit, state, q) || (DEEP && is_close(state, q))) { break; }
            let step = raised(fractal, state.z, q);
            tangent = turned(fractal, tangent, step, state.z, q);
            state = step_on(state, step.power, orbit);
            q = squares(state.z);
        }
        if (!DEEP || has_ended(fractal, orbit, state, q)) { break; }
    }
    if (q.s <= 1.0) { return vec3f(0.0); }
    return gradient_at(state.z, q, tangent.jacobian, tangent.slope);
}

// The same at an orbit's end, by its Jacobian over dr and the gradient of dr over dr^2.
fn gradient_at(z: vec3f, q: Squares, jacobian: mat3x3f, slope: vec3f) -> vec3f {
    let r = sqrt(q.s);
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
    if (ROTATING_FRAME) {
        let end = rotating_end(fractal, point);
        return colors_of(fractal, end.q, end.count, end.traps);
    }
    let orbit = orbit_of(fractal, point);
    var state = initial_state(orbit, point);
    // Squared until the end.
    var traps = vec3f(4.0);
    if (DEEP) {
        let which = series_of(point);
        for (; which < SERIES; ) {
            state = far_state(which, point);
            traps = anchor_orbit.series[which].traps_squared;
            break;
        }
    }
    var q = squares(state.z);
    for (; ; ) {
        for (; DEEP; ) {
            if (has_ended(fractal, orbit, state, q) || !is_close(state, q)) { break; }
            state = step_close(state, raised_next(fractal, state, q), orbit);
            q = squares(state.z);
            traps = min(traps, vec3f(q.s, q.a, q.zz));
        }
        for (; ; ) {
            if (has_ended(fractal, orbit, state, q) || (DEEP && is_close(state, q))) { break; }
            state = step_on(state, raised(fractal, state.z, q).power, orbit);
            q = squares(state.z);
            traps = min(traps, vec3f(q.s, q.a, q.zz));
        }
        if (!DEEP || has_ended(fractal, orbit, state, q)) { break; }
    }
    return colors_of(fractal, q, state.count, traps);
}

// Of an orbit's end after so many steps, and its squared traps.
fn colors_of(fractal: Fractal, q: Squares, count: u32, traps: vec3f) -> OrbitColors {
    var smooth_iterations = f32(count);
    if (q.s > fractal.bailout * fractal.bailout) {
        smooth_iterations -= log2(max(0.5 * log2(q.s) / fractal.log2_bailout, 1.0)) / log2(fractal.power);
    }
    return OrbitColors(smooth_iterations, sqrt(traps));
}
