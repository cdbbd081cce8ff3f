// Perturbed steps, which follow the difference to the reference orbit: views that plain f32 cannot draw.
// Host twin: `deep/field.rs`.

const MIXES_STEPS = true;

// Number of near steps: perturbed steps that all orbits near the anchor take; 0 to `MAX_NEAR_STEPS`.
override NEAR_STEPS: u32 = 2u;

// True if a series approximation precedes the near steps; else the near steps are an orbit's first.
override HAS_SERIES: bool = true;

// True if the stretch of the ray's own direction sets a ray's step, false if a product of bounds does.
override FOLLOWS_DIRECTION: bool = true;

// Deep views are of whole powers.
const HAS_SEAM = false;

struct OrbitState {
    z: vec3f,
    // Number of steps taken.
    count: u32,
    // Difference to a reference point, and the reference point's index.
    difference: vec3f,
    index: u32,
}

// An orbit in progress.
struct Walk {
    state: OrbitState,
    // Squares of the state's z.
    q: Squares,
    gathered: Gathered,
}

// The distance from the polar axis, even if its square is too small for an f32.
fn rho_of(z: vec3f, q: Squares) -> f32 {
    return max(length_of(z.xy), 1e-37);
}

fn initial_state(orbit: Orbit, point: vec3f) -> OrbitState {
    return OrbitState(orbit.start, 0u, orbit.start_derivative * point, 0u);
}

fn begin_walk(gathers: u32, fractal: Fractal, orbit: Orbit, point: vec3f, along: vec3f) -> Walk {
    var state = initial_state(orbit, point);
    var begun = initial_gathered(fractal, orbit, along);
    let which = series_of(point);
    for (; which < SERIES; ) {
        state = far_state(which, point);
        let series = anchor_orbit.series[which];
        begun.derivatives = series_derivatives(fractal, series, point, along, which);
        begun.tangent = series_tangent(series, orbit, point);
        begun.traps = series.traps;
        break;
    }
    return Walk(state, squares(state.z), begun);
}

fn is_perturbed(fractal: Fractal, walk: Walk) -> bool {
    return is_close(fractal, walk.state, walk.q);
}

fn perturbed_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    let step = raised_next(fractal, walk.state, walk.q);
    let state = step_close(walk.state, step, orbit);
    return walked(gathers, fractal, orbit, along, walk, step, state);
}

fn plain_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    let step = raised(fractal, walk.state.z, walk.q);
    let state = step_anew(fractal, walk.state, step.power, orbit);
    return walked(gathers, fractal, orbit, along, walk, step, state);
}

fn walked(
    gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk, step: Raised, state: OrbitState,
) -> Walk {
    let q = squares(state.z);
    let after = gathered(gathers, fractal, orbit, along, walk.gathered, step, walk.state.z, walk.q, state.z);
    return Walk(state, q, after);
}

fn end_estimate(fractal: Fractal, walk: Walk) -> Estimate {
    return estimate_at(fractal, walk.gathered.derivatives, walk.q);
}

fn end_gradient(fractal: Fractal, walk: Walk) -> vec3f {
    return gradient_at(fractal, walk.state.z, walk.q, walk.gathered.tangent.jacobian, walk.gathered.tangent.slope);
}

fn end_traps(walk: Walk) -> vec2f {
    return walk.gathered.traps;
}

fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return estimate(fractal, point, along);
}

// The direction that orbits in view stretch most. It stands for the directions of all rays of a cone.
fn cone_direction() -> vec3f {
    return frame.formula.cone_direction;
}

// True if the view's series approximation and near steps hold for a point.
fn is_near(fractal: Fractal, point: vec3f) -> bool {
    return dot(point, point) < fractal.near_radius_squared;
}

// True if the pixel at a point is wide enough for plain f32.
fn is_far(fractal: Fractal, point: vec3f) -> bool {
    // Compares coordinates: the square of the distance may overflow an f32.
    return max(max(abs(point.x), abs(point.y)), abs(point.z)) > fractal.far_radius;
}

// True if the next step is a perturbed step.
fn is_close(fractal: Fractal, state: OrbitState, q: Squares) -> bool {
    let next = state.index + 1u;
    let goes_on = (next != fractal.own_points) & (next < fractal.reference_points);
    // The square of a tiny difference underflows to 0, which is small enough here.
    return goes_on & (dot(state.difference, state.difference) < CLOSE * CLOSE * q.s);
}

// One step of the difference to `reference`; `rho` is the orbit's own distance from the axis.
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

// One step of the difference to the state's reference point. Also exact if the square of rho underflows.
fn raised_next(fractal: Fractal, state: OrbitState, q: Squares) -> Raised {
    return raised_close(fractal, state, anchor_orbit.points[state.index], length_of(state.z.xy), q);
}

// Moves on by a perturbed step.
fn step_close(state: OrbitState, step: Raised, orbit: Orbit) -> OrbitState {
    return step_to(state, anchor_orbit.points[state.index + 1u].z, step, orbit);
}

// Moves on by a perturbed step to the reference point `reference`.
fn step_to(state: OrbitState, reference: vec3f, step: Raised, orbit: Orbit) -> OrbitState {
    let difference = step.power + orbit.added;
    return OrbitState(reference + difference, state.count + 1u, difference, state.index + 1u);
}

// Moves on to z^n + c by a plain step, and rebases: takes the difference to the restart point.
fn step_anew(fractal: Fractal, state: OrbitState, power: vec3f, orbit: Orbit) -> OrbitState {
    let difference = power + orbit.added;
    let z = orbit.constant + difference;
    return OrbitState(z, state.count + 1u, difference, fractal.restart);
}

// Takes the near step from `frame.formula.near[index]`, unless the orbit has escaped.
fn near_step(
    index: u32, state: ptr<function, OrbitState>, derivatives: ptr<function, Derivatives>,
    fractal: Fractal, orbit: Orbit, along: vec3f,
) {
    let q = squares((*state).z);
    // No orbit escapes before the first near step: it starts in the bounding sphere, or after the series.
    if (index > 0u && q.s > orbit.limit) { return; }
    let step = raised_close(fractal, *state, frame.formula.near[index], sqrt(q.a), q);
    *derivatives = next_derivatives(fractal, orbit, along, *derivatives, step, (*state).z, q);
    *state = step_to(*state, frame.formula.near[index + 1u].z, step, orbit);
}

// The estimate by near steps, or by plain steps far from the anchor. If neither is exact enough, the
// returned step is negative: outside the radius of the near steps, and for orbits whose
// dr falls below `min_derivative` after the near steps.
fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    let orbit = orbit_of(fractal, point);
    var state = initial_state(orbit, point);
    var derivatives = initial_derivatives(fractal, orbit, along);
    if (HAS_SERIES) {
        state = series_state(frame.formula.series, frame.formula.near[0].z, point);
        derivatives = series_derivatives(fractal, frame.formula.series, point, along, 0u);
    }
    // Unrolled by hand: llvmpipe keeps a loop of four or more, which takes twice the time.
    near_step(0u, &state, &derivatives, fractal, orbit, along);
    if (NEAR_STEPS > 1u) { near_step(1u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 2u) { near_step(2u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 3u) { near_step(3u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 4u) { near_step(4u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 5u) { near_step(5u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 6u) { near_step(6u, &state, &derivatives, fractal, orbit, along); }
    if (NEAR_STEPS > 7u) { near_step(7u, &state, &derivatives, fractal, orbit, along); }
    var q = squares(state.z);
    var is_quick = is_near(fractal, point);
    var least = fractal.min_derivative / max(0.5 * length(point), 1.0);
    if (HAS_SERIES && is_far(fractal, point)) {
        is_quick = true;
        least = 0.0;
        state.z = orbit.start + BESIDE_AXIS;
        state.count = 0u;
        derivatives = initial_derivatives(fractal, orbit, along);
        q = squares(state.z);
    }
    let constant = orbit.constant + orbit.added;
    for (; ; ) {
        if (!is_quick || has_ended(fractal, orbit, state.count, q) || derivatives.dr < least) { break; }
        let step = raised(fractal, state.z, q);
        derivatives = next_derivatives(fractal, orbit, along, derivatives, step, state.z, q);
        state.z = step.power + constant;
        state.count += 1u;
        q = squares(state.z);
    }
    if (!is_quick || derivatives.dr < least) { return Estimate(0.0, -1.0); }
    return estimate_at(fractal, derivatives, q);
}
