// Derivatives of an orbit by its point, for plain and perturbed steps: estimates and gradients use them.

// Step of a ray over the estimate by dg: `estimator::step_factor`.
fn step_factor(fractal: Fractal) -> f32 {
    return clamp(0.75 * fractal.power, 3.0, 6.0);
}

// Derivatives of an orbit by its point.
struct Derivatives {
    dr: f32,
    // Product of bounds on the stretch, over the step factor: a ray's step is at most the height over the
    // larger of dr and dg. Over the many steps of a deep orbit dg grows far past the Jacobian's norm, so that
    // `FOLLOWS_DIRECTION` has two stretched directions instead.
    dg: f32,
    // Jacobian times the ray's own direction, with `FOLLOWS_DIRECTION` or `HAS_SEAM`.
    stretched: vec3f,
    // Stretch of the series approximation across its widest direction, over dr. At a scale of 1e-20 it is
    // 1/3 to 1/100 of the widest stretch.
    rest: f32,
    // Greatest turn of an orbit point about the polar axis per length of the ray, times the power up to
    // `TURNED_POWER_MAX`, with `FOLLOWS_DIRECTION`.
    turn: f32,
    // One over the longest step that keeps all orbit points on their sides of the seams and of the origin, without
    // `FOLLOWS_DIRECTION`; 0 if any step does.
    inverse_limit: f32,
}

// Longest step of a ray times `Derivatives.turn`. A step raises the angle about the axis n-fold: past a turn of that
// order, the orbit's Jacobian is another one.
const TURN_MAX = 3.0;

// Greatest power that counts in `Derivatives.turn`: at power 16, the whole power costs a third more steps.
const TURNED_POWER_MAX = 8.0;

fn initial_derivatives(fractal: Fractal, orbit: Orbit, along: vec3f) -> Derivatives {
    let one = orbit.start_derivative;
    let dg = select(one / step_factor(fractal), 0.0, FOLLOWS_DIRECTION);
    return Derivatives(one, dg, one * along, 1.0, 0.0, 0.0);
}

// Longest step of a ray of a Julia set, over the way by which an orbit point would get to the origin. There dr vanishes,
// so that the estimate grows without bound, close to a surface too; the Mandelbulb's dr is at least 1.
const ORIGIN_PART = 0.5;

// `Derivatives.inverse_limit` by the origin, for an orbit point with the squares `q`.
fn origin_rate(orbit: Orbit, before: Derivatives, q: Squares) -> f32 {
    if (orbit.constant_derivative > 0.0) { return 0.0; }
    return max(before.dg, before.dr) * inverseSqrt(max(q.s, 1e-36)) / ORIGIN_PART;
}

// `Derivatives.inverse_limit` by the seam of a power that is not whole, for the orbit point `z`: z^n jumps at the half
// plane y = 0, x < 0, so that an estimate on one side says nothing about the other.
fn seam_rate(
    fractal: Fractal, before: Derivatives, z: vec3f, inverse_rho: f32, along: vec3f,
) -> f32 {
    if (all(along == vec3f(0.0))) {
        // A cone's rays move the point in every direction, the most stretched one too.
        let inverse = select(inverse_rho, 1.0 / max(abs(z.y), 1e-18), z.x < 0.0);
        return step_factor(fractal) * before.dg * inverse;
    }
    let v = before.stretched;
    let rate = max(-v.y * z.y / max(z.y * z.y, 1e-36), 0.0);
    return select(0.0, rate, rate * z.x + v.x < 0.0);
}

// Derivatives after a step. `along`: the ray's direction, a unit vector.
fn next_derivatives(
    fractal: Fractal, orbit: Orbit, along: vec3f, before: Derivatives, step: Raised, z: vec3f, q: Squares,
) -> Derivatives {
    // Clamped before the step: the last step of an orbit may multiply by 1e19.
    let dr = step.stretch * min(before.dr, fractal.derivative_max) + orbit.constant_derivative;
    if (!FOLLOWS_DIRECTION) {
        let bound = max(abs(sideways(fractal, step, SIDEWAYS_MAX)), step.stretch);
        let dg = bound * min(before.dg, fractal.derivative_max);
        let added = orbit.constant_derivative / step_factor(fractal);
        let inverse_limit = max(before.inverse_limit, origin_rate(orbit, before, q));
        // Kernels of any power draw whole powers too.
        if (!HAS_SEAM || fractal.power == floor(fractal.power)) {
            return Derivatives(dr, dg + added, vec3f(0.0), 0.0, 0.0, inverse_limit);
        }
        let seam = seam_rate(fractal, before, z, step.inverse_rho, along);
        let stretched = pushed(fractal, step, z, q, before.stretched) + orbit.constant_derivative * along;
        return Derivatives(dr, dg + added, stretched, 0.0, 0.0, max(inverse_limit, seam));
    }
    let stretched = pushed(fractal, step, z, q, before.stretched) + orbit.constant_derivative * along;
    // Coordinates instead of the length, whose square may overflow.
    let aside = max(abs(before.stretched.x), abs(before.stretched.y));
    let turn = min(fractal.power, TURNED_POWER_MAX) * aside * step.inverse_rho;
    return Derivatives(dr, before.dg, stretched, before.rest, max(before.turn, turn), 0.0);
}

// A ray's safe step. `height`: see `height_of`. The scalar dr ignores the stretch along parallels, so the
// step is the step factor times the estimate by dg, which bounds that stretch, and at most the distance. It ends
// before any orbit point gets to a seam or the origin. With `HAS_SEAM` it is also at most the distance over the stretch of
// the ray's direction.
// With `FOLLOWS_DIRECTION` the step is the distance over the stretch of the ray's direction, as far as that stretch
// holds: no orbit point may turn about the axis by more than `TURN_MAX`.
fn safe_step(derivatives: Derivatives, height: f32) -> f32 {
    // The square of `stretched` can overflow with a large bailout.
    let inverse = 1.0 / max(derivatives.dr, 1e-37);
    let followed = length(inverse * derivatives.stretched);
    if (!FOLLOWS_DIRECTION) {
        let step = height / max(max(derivatives.dg, derivatives.dr), 1e-37);
        let followed_step = select(step, inverse * height / max(followed, 1.0), HAS_SEAM);
        return min(min(step, followed_step), 1.0 / max(derivatives.inverse_limit, 1e-30));
    }
    let stretch = max(max(followed, derivatives.rest), 1.0);
    return min(inverse * height / stretch, TURN_MAX / max(derivatives.turn, 1e-30));
}

// Derivatives of an orbit and of dr by the point.
struct Tangent {
    // The orbit's Jacobian over dr.
    jacobian: mat3x3f,
    // The gradient of dr over dr^2.
    slope: vec3f,
    // The constant's own derivative over dr.
    added: f32,
}

fn initial_tangent(orbit: Orbit) -> Tangent {
    let added = orbit.constant_derivative / orbit.start_derivative;
    return Tangent(scaled_identity(1.0), vec3f(0.0), added);
}

// The tangent after another step.
fn turned(fractal: Fractal, before: Tangent, step: Raised, z: vec3f, q: Squares) -> Tangent {
    // This dr over the next, clamped: infinite if a Julia orbit meets the origin.
    let shrink = 1.0 / max(step.stretch + before.added, 1e-9);
    let kept = step.stretch * shrink;
    let added = before.added * shrink;
    let along = (fractal.power - 1.0) / max(q.s, 1e-18) * (z * before.jacobian);
    let turn = raised_jacobian(fractal, step, z, rho_of(z, q), q, 1e6);
    let jacobian = shrink * (turn * before.jacobian) + scaled_identity(added);
    return Tangent(jacobian, (kept * shrink) * (along + before.slope), added);
}

// What a walk gathers. Each walk computes only one of the three.
struct Gathered {
    derivatives: Derivatives,
    tangent: Tangent,
    // Least distances from the colour layers' traps.
    traps: vec2f,
}

fn initial_gathered(fractal: Fractal, orbit: Orbit, along: vec3f) -> Gathered {
    return Gathered(initial_derivatives(fractal, orbit, along), initial_tangent(orbit), vec2f(MAX_TRAP));
}

// Updates what a walk gathers, after a step from `z`, which has the squares `q`, to `next`.
fn gathered(
    gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, before: Gathered, step: Raised,
    z: vec3f, q: Squares, next: vec3f,
) -> Gathered {
    var after = before;
    if (gathers == GATHER_ESTIMATE) {
        after.derivatives = next_derivatives(fractal, orbit, along, before.derivatives, step, z, q);
    }
    if (gathers == GATHER_GRADIENT) { after.tangent = turned(fractal, before.tangent, step, z, q); }
    if (gathers == GATHER_COLORS) { after.traps = nearer_traps(before.traps, next); }
    return after;
}

// The estimate at an orbit's end.
fn estimate_at(fractal: Fractal, derivatives: Derivatives, q: Squares) -> Estimate {
    let height = height_of(fractal, q);
    if (height <= 0.0) { return Estimate(0.0, 0.0); }
    let distance = height / max(derivatives.dr, 1e-37);
    return Estimate(distance, min(safe_step(derivatives, height), fractal.max_step));
}
