// Perturbed orbits: the difference of an orbit to the anchor's, which f32 can follow at any depth. Host
// twin, with the equations: `fractal::deep`.
//
// Points are offsets from the anchor in units of the scale s, and so are distances; derivatives are
// in units of 1 / s, so that nothing overflows.

// True in pipelines of views that are drawn from an anchor.
override DEEP: bool = false;

// Near steps: perturbed steps that all orbits near the anchor take, 0 to `MOST_NEAR_STEPS`.
override NEAR_STEPS: u32 = 2u;
// True if a series approximation precedes the near steps; else they are an orbit's first steps.
override HAS_SERIES: bool = true;
// True if a ray's step follows the stretch of the ray's own direction, false if a product of bounds.
override FOLLOWS_DIRECTION: bool = DEEP && (HAS_SERIES || NEAR_STEPS == 0u);

// Orbits take perturbed steps while the difference is below this part of |z|: `fractal::deep::CLOSE`.
const CLOSE = 0.01;

// Radius of the first of `anchor_orbit.series`, in scales, and the ratio of each radius to the last:
// `render::uniforms::depth`.
const FIRST_RADIUS = 12.0;
const RADII_RATIO = 8.0;

// An orbit under way.
struct OrbitState {
    // Where it is.
    z: vec3f,
    // How many steps it has gone.
    count: u32,
    // Its difference to a place of the reference, and that place's index. Of deep views only.
    difference: vec3f,
    index: u32,
}

// Index of the series approximation for a point; `SERIES` if the point is outside all radii.
fn series_of(point: vec3f) -> u32 {
    let radii = log2(dot(point, point) / (FIRST_RADIUS * FIRST_RADIUS)) / (2.0 * log2(RADII_RATIO));
    return u32(clamp(ceil(radii), 0.0, f32(SERIES)));
}

// True if the series approximation and the near steps of the picture itself hold for a point.
fn is_near(point: vec3f) -> bool {
    return dot(point, point) < frame.fractal.near_radius_squared;
}

// True if the pixel at a point is wide enough for plain f32.
fn is_far(point: vec3f) -> bool {
    // Its square may be past what an f32 holds.
    return max(max(abs(point.x), abs(point.y)), abs(point.z)) > frame.fractal.far_radius;
}

// State behind the steps of a series approximation.
fn series_state(series: SeriesApproximation, reference: vec3f, point: vec3f) -> OrbitState {
    // The mean of the Jacobians at the anchor and at the point: of a second-order polynomial.
    let at_anchor = mat3x3f(series.along_x, series.along_y, series.along_z);
    let difference = 0.5 * ((at_anchor + series_jacobian(series, point)) * point);
    return OrbitState(reference + difference, series.steps, difference, series.steps);
}

// The same of a series approximation in `anchor_orbit`.
fn far_state(which: u32, point: vec3f) -> OrbitState {
    let series = anchor_orbit.series[which];
    return series_state(series, anchor_orbit.points[series.steps].z, point);
}

// dr behind those steps.
fn series_derivative(series: SeriesApproximation, point: vec3f) -> f32 {
    return series.derivative + dot(series.derivative_gradient, point);
}

fn series_derivatives(
    fractal: Fractal, series: SeriesApproximation, point: vec3f, along: vec3f, which: u32,
) -> Derivatives {
    let jacobian = series_jacobian(series, point);
    let stretched = jacobian * along;
    // Of directions across the widest; from farther away it would be followed over too many steps.
    var bound = select(0.0, series.rest, which < 2u);
    if (!FOLLOWS_DIRECTION) { bound = length(jacobian * series.widest); }
    let dg = bound / step_factor(fractal);
    return Derivatives(series_derivative(series, point), dg, stretched, series.rest / series.derivative);
}

// Whether the next step is one of the difference.
fn is_close(state: OrbitState, q: Squares) -> bool {
    let next = state.index + 1u;
    let goes_on = (next != frame.fractal.own_points) & (next < frame.fractal.reference_points);
    // Squares of tiny differences are 0, which is what they are meant to be here.
    return goes_on & (dot(state.difference, state.difference) < CLOSE * CLOSE * q.s);
}

// A complex number and how another differs from it.
struct Pair {
    value: vec2f,
    difference: vec2f,
}

fn pair_square(v: Pair) -> Pair {
    return Pair(
        complex_square(v.value),
        complex_product(v.difference, v.value + v.value + v.difference),
    );
}

fn pair_product(v: Pair, w: Pair) -> Pair {
    return Pair(
        complex_product(v.value, w.value),
        complex_product(v.difference, w.value) + complex_product(v.value + v.difference, w.difference),
    );
}

fn pair_power_bit(v: Pair, w: Pair, bit: u32) -> Pair {
    let squared = pair_square(v);
    if (bit != 0u) { return pair_product(squared, w); }
    return squared;
}

// w^n for n from 1 to 16.
fn pair_power(w: Pair, n: u32) -> Pair {
    var v = w;
    if (n >= 16u) { v = pair_square(v); }
    if (n >= 8u) { v = pair_power_bit(v, w, n & 4u); }
    if (n >= 4u) { v = pair_power_bit(v, w, n & 2u); }
    if (n >= 2u) { v = pair_power_bit(v, w, n & 1u); }
    return v;
}

// |v|, also where its square is too small for an f32.
fn length_of(v: vec2f) -> f32 {
    let is_tiny = max(abs(v.x), abs(v.y)) < 1e-15;
    let up = select(1.0, 1e18, is_tiny);
    let down = select(1.0, 1e-18, is_tiny);
    return length(up * v) * down;
}

// How an orbit's radius beside the axis and its rotor differ from a place's.
struct Deviation {
    rho: f32,
    rotor: vec2f,
    // One over the orbit's own.
    inverse_rho: f32,
}

// `aside`: the difference across the axis; `rho`: the orbit's own.
fn deviation(reference: ReferencePoint, aside: vec2f, rho: f32) -> Deviation {
    let inverse_rho = 1.0 / max(rho, 1e-37);
    let inverse_sum = 1.0 / max(rho + reference.rho, 1e-37);
    let along = dot(reference.rotor, aside);
    let d_rho = 2.0 * (reference.rho * inverse_sum) * along + dot(aside, inverse_sum * aside);
    // On the axis the rotor is 1.
    let turned = inverse_rho * (aside - d_rho * reference.rotor);
    let d_rotor = select(vec2f(1.0, 0.0) - reference.rotor, turned, rho > 0.0);
    return Deviation(d_rho, d_rotor, inverse_rho);
}

// One step of the difference to `reference`, where the orbit itself is `rho` from the axis.
fn raised_close(
    fractal: Fractal, state: OrbitState, reference: ReferencePoint, rho: f32, q: Squares,
) -> Raised {
    let d = deviation(reference, state.difference.xy, rho);
    let w = pair_power(Pair(vec2f(reference.rho, reference.z.z), vec2f(d.rho, state.difference.z)), POWER);
    let u = pair_power(Pair(reference.rotor, d.rotor), POWER);
    let wn = w.value + w.difference;
    let un = u.value + u.difference;
    let across = w.value.x * u.difference + w.difference.x * un;
    let power = vec3f(across, fractal.z_sign * w.difference.y);
    return Raised(power, stretch_whole(fractal, q), d.inverse_rho, un, wn);
}

// The same to a place of the reference. It also holds where the square of rho is too small for an f32.
fn raised_next(fractal: Fractal, state: OrbitState, q: Squares) -> Raised {
    return raised_close(fractal, state, anchor_orbit.points[state.index], length_of(state.z.xy), q);
}

// Goes on by such a step.
fn step_close(state: OrbitState, step: Raised, orbit: Orbit) -> OrbitState {
    return step_to(state, anchor_orbit.points[state.index + 1u].z, step, orbit);
}

// The same to a place that is known.
fn step_to(state: OrbitState, reference: vec3f, step: Raised, orbit: Orbit) -> OrbitState {
    let difference = step.power + orbit.added;
    return OrbitState(reference + difference, state.count + 1u, difference, state.index + 1u);
}

// Goes on from z^n: its difference to where orbits start anew (rebasing).
fn step_anew(state: OrbitState, power: vec3f, orbit: Orbit) -> OrbitState {
    let difference = power + orbit.added;
    let z = orbit.constant + difference;
    return OrbitState(z, state.count + 1u, difference, frame.fractal.restart);
}

// What a step makes of directions, but for those along parallels: turns the meridian's plane, which
// is toward u, by m, to the one toward un.
struct Meridian {
    u: vec2f,
    m: vec2f,
    un: vec2f,
    z_sign: f32,
}

fn raised_along(meridian: Meridian, v: vec3f) -> vec3f {
    let raised = complex_product(meridian.m, vec2f(dot(meridian.u, v.xy), v.z));
    return vec3f(raised.x * meridian.un, meridian.z_sign * raised.y);
}

// What a step makes of a direction: its Jacobian times that, with sideways stretching clamped.
fn pushed(fractal: Fractal, step: Raised, z: vec3f, q: Squares, v: vec3f) -> vec3f {
    let u = step.inverse_rho * z.xy;
    let w = vec2f(step.inverse_rho * q.a, -z.z);
    let m = (fractal.power / q.s) * complex_product(step.wn, w);
    let along = raised_along(Meridian(u, m, step.un, fractal.z_sign), v);
    let parallel = sideways(fractal, step, DEEP_SIDEWAYS_MAX) * (u.x * v.y - u.y * v.x);
    return vec3f(along.xy + parallel * vec2f(-step.un.y, step.un.x), along.z);
}

// Tangent behind the steps of a series approximation.
fn series_tangent(series: SeriesApproximation, orbit: Orbit, point: vec3f) -> Tangent {
    let inverse = 1.0 / series_derivative(series, point);
    return Tangent(
        inverse * series_jacobian(series, point),
        (inverse * inverse) * series.derivative_gradient,
        inverse * orbit.constant_derivative,
    );
}

// The Jacobian behind them.
fn series_jacobian(series: SeriesApproximation, point: vec3f) -> mat3x3f {
    return mat3x3f(
        series.along_x + point.x * series.along_xx + point.y * series.along_xy + point.z * series.along_zx,
        series.along_y + point.y * series.along_yy + point.z * series.along_yz + point.x * series.along_xy,
        series.along_z + point.z * series.along_zz + point.x * series.along_zx + point.y * series.along_yz,
    );
}
