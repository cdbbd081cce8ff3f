// Orbits of formulas' texts. The texts' own functions come from `operations.rs`:
//     State                  vec3f or vec4f
//     load_slots             copies what depends on parameters only, before an orbit
//     initial, initial_rows  the state at the start, its derivatives
//     next_with_derivative   the step with the number n, with the running derivative if the text gives it
//     next_with_channel      the step with the number n, and what it adds to the colour channel
//     extent_test, extent    what is compared with `limit`, and the size itself
// uses: types/estimate, lib/numeric, lib/trap

// Derivatives are clamped to this before each step, which must not overflow.
const MAX_DERIVATIVE = 1e30;

// Derivatives of a vector's components in three directions.
struct Rows {
    x: vec3f,
    y: vec3f,
    z: vec3f,
    w: vec3f,
}

const POINT_ROWS = Rows(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), vec3f(0.0, 0.0, 1.0), vec3f(0.0));

fn scaled_rows(rows: Rows, by: f32) -> Rows {
    return Rows(by * rows.x, by * rows.y, by * rows.z, by * rows.w);
}

fn natural_log(x: f32) -> f32 {
    return 0.69314718 * accurate_log2(max(x, 1.1754944e-38));
}

fn exponential(x: f32) -> f32 {
    return accurate_exp2(min(1.442695 * x, 127.0));
}

fn power(x: f32, y: f32) -> f32 {
    return accurate_exp2(min(y * accurate_log2(max(x, 1.1754944e-38)), 127.0));
}

fn sine(x: f32) -> f32 {
    return cos_sin_turns(0.15915494 * x).y;
}

fn cosine(x: f32) -> f32 {
    return cos_sin_turns(0.15915494 * x).x;
}

fn angle(y: f32, x: f32) -> f32 {
    // The origin's angle is 0.
    let is_origin = max(abs(x), abs(y)) < 1e-37;
    return 6.2831853 * angle_turns(y, select(x, 1.0, is_origin));
}

// What each step adds.
fn addend(fractal: Fractal, point: vec3f) -> State {
    return select(as_state(fractal.julia_constant), initial(point), fractal.addend_derivative > 0.0);
}

fn is_escaped(fractal: Fractal, z: State) -> bool {
    // True for not-a-number too, so that such orbits end.
    return !(extent_test(z) <= fractal.limit);
}

fn estimate_of(fractal: Fractal, distance: f32) -> Estimate {
    // Not-a-number and negative distances count as inside.
    let outside = clamp(select(0.0, distance, distance > 0.0), 0.0, 1e30);
    return Estimate(outside, min(fractal.march * outside, fractal.max_step));
}

fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return estimate(fractal, point, along);
}

// Never called: the quick estimate is exact.
fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return Estimate(0.0, 0.0);
}

// The direction that stands for all rays of a cone: none, since estimates hold in every direction.
fn cone_direction() -> vec3f {
    return vec3f(0.0);
}

fn distance_estimate(fractal: Fractal, point: vec3f) -> f32 {
    return estimate(fractal, point, vec3f(0.0)).distance;
}

// Part of the last step that lies beyond the bailout, 0 to 1: thesis eq. 3.1 with the exponent, or for
// linear growth the factor, that the last step shows.
fn excess(fractal: Fractal, before: f32, last: f32) -> f32 {
    let grown = natural_log(last);
    let least = natural_log(before);
    if (fractal.is_power > 0.0) {
        let ratio = natural_log(max(grown / fractal.log_bailout, 1.0));
        return clamp(ratio / natural_log(max(grown / max(least, 1e-4), 1.0001)), 0.0, 1.0);
    }
    return clamp((grown - fractal.log_bailout) / max(grown - least, 1e-4), 0.0, 1.0);
}

fn orbit_colors(fractal: Fractal, point: vec3f) -> OrbitColors {
    load_slots();
    let c = addend(fractal, point);
    var z = initial(point);
    var before = z;
    var dr = fractal.initial_derivative;
    var channel = 0.0;
    var traps = vec2f(MAX_TRAP / fractal.trap_scale);
    var n = 0u;
    for (; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        before = z;
        let next = next_with_channel(n, z, c, point, dr, fractal.addend_derivative);
        z = next.z;
        dr = min(next.dr, MAX_DERIVATIVE);
        channel += next.channel;
        traps = nearer_traps(traps, z.xyz);
    }
    var smooth_iterations = f32(n);
    if (is_escaped(fractal, z) && n > 0u) {
        smooth_iterations -= excess(fractal, extent(before), extent(z));
    }
    let is_inside = select(!is_escaped(fractal, z), !(distance_at(z, point, dr) > 0.0), fractal.has_own_distance != 0u);
    return OrbitColors(smooth_iterations, is_inside, channel / max(f32(n), 1.0), fractal.trap_scale * traps);
}
