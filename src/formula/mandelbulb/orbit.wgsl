// One driver for all orbits of the Mandelbulb and its Julia form: distance estimates, gradients and
// orbit colours. One of three stepper files adds the steps: `plain`, `perturbed` or `rotating_frame`.
//
// A stepper declares
//     struct Walk            an orbit under way: its state, its squares `q`, what is gathered along it
//     begin_walk             the walk at the orbit's start, or behind the steps of a series
//     MIXES_STEPS            whether orbits have steps of both kinds
//     is_perturbed           whether the next step is a perturbed one
//     perturbed_step, plain_step
//     end_estimate, end_gradient, end_traps
//     quick_estimate, careful_estimate, cone_direction
//     orbit_of               the orbit of a point (for orbits about an anchor in `difference`)
//     rho_of, FOLLOWS_DIRECTION, HAS_SEAM   for `derivatives`, where a stepper uses that file
// uses: types/estimate, lib/trap

// What a walk computes along the orbit.
const GATHER_ESTIMATE = 0u;
const GATHER_GRADIENT = 1u;
const GATHER_COLORS = 2u;

// An orbit's start, and what its steps add.
struct Orbit {
    start: vec3f,
    constant: vec3f,
    // Addend of each step of the difference; for orbits about an anchor.
    added: vec3f,
    // Derivative of the constant by the point: 0 for the Julia form.
    constant_derivative: f32,
    // Derivative of the start by the point.
    start_derivative: f32,
    // The bailout's square.
    limit: f32,
}

fn has_ended(fractal: Fractal, orbit: Orbit, count: u32, q: Squares) -> bool {
    return (q.s > orbit.limit) | (count >= fractal.iterations);
}

// Follows the orbit of `point` until it escapes or reaches the iterations.
// Each kind of step has its own loop: lanes that disagree on a branch compute both sides.
fn walk_orbit(gathers: u32, fractal: Fractal, point: vec3f, along: vec3f) -> Walk {
    let orbit = orbit_of(fractal, point);
    var walk = begin_walk(gathers, fractal, orbit, point, along);
    for (; ; ) {
        for (; ; ) {
            if (has_ended(fractal, orbit, walk.state.count, walk.q) || !is_perturbed(fractal, walk)) { break; }
            walk = perturbed_step(gathers, fractal, orbit, along, walk);
        }
        for (; ; ) {
            if (has_ended(fractal, orbit, walk.state.count, walk.q) || is_perturbed(fractal, walk)) { break; }
            walk = plain_step(gathers, fractal, orbit, along, walk);
        }
        if (!MIXES_STEPS || has_ended(fractal, orbit, walk.state.count, walk.q)) { break; }
    }
    return walk;
}

// The estimate at a point, exact everywhere. `along`: the ray's direction, a unit vector.
fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return end_estimate(fractal, walk_orbit(GATHER_ESTIMATE, fractal, point, along));
}

fn distance_estimate(fractal: Fractal, point: vec3f) -> f32 {
    return estimate(fractal, point, vec3f(0.0)).distance;
}

// The direction in which `distance_estimate` grows fastest, not normalised; 0 inside. Exact: the walk
// carries the orbit's Jacobian and the gradient of dr (forward differentiation).
//     grad DE = ((ln r + 1) dr grad r - r ln r grad dr) / (2 dr^2),  grad r = J^T z / r
// J grows as dr and grad dr as dr squared, past the range of an f32: the walk stores J over dr and
// grad dr over dr^2, which keeps the direction.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    let walk = walk_orbit(GATHER_GRADIENT, fractal, point, vec3f(0.0));
    if (log_radius(fractal, walk.q) <= 0.0) { return vec3f(0.0); }
    return end_gradient(fractal, walk);
}

fn orbit_colors(fractal: Fractal, point: vec3f) -> OrbitColors {
    let walk = walk_orbit(GATHER_COLORS, fractal, point, vec3f(0.0));
    var smooth_iterations = f32(walk.state.count);
    let is_inside = walk.q.s <= fractal.bailout * fractal.bailout;
    if (!is_inside) {
        let excess = log2(max(0.5 * log2(walk.q.s) / fractal.log2_bailout, 1.0));
        smooth_iterations -= excess / log2(fractal.power);
    }
    return OrbitColors(smooth_iterations, is_inside, 0.0, end_traps(walk));
}

// ln r at an orbit's end, or ln(r/R) with the escape radius R if the iterations have ended before the orbit passes the
// bailout. Not positive: the orbit may be one of the set's, which never leave R.
fn log_radius(fractal: Fractal, q: Squares) -> f32 {
    let has_passed = q.s > fractal.bailout * fractal.bailout;
    return 0.5 * log(max(q.s, 1e-36)) - select(fractal.log_escape_radius, 0.0, has_passed);
}

// 0.5 ln(r) r, with `log_radius` for ln(r): the distance estimate times dr.
fn height_of(fractal: Fractal, q: Squares) -> f32 {
    return 0.5 * log_radius(fractal, q) * sqrt(q.s);
}

// The gradient at an orbit's end, from its Jacobian over dr and the gradient of dr over dr^2.
fn gradient_at(fractal: Fractal, z: vec3f, q: Squares, jacobian: mat3x3f, slope: vec3f) -> vec3f {
    let r = sqrt(q.s);
    let log_r = log_radius(fractal, q);
    return (log_r + 1.0) / r * (z * jacobian) - r * log_r * slope;
}
