// Orbits by their difference to the anchor's: what f32 can follow at any depth. Host twin, with the
// equations: `fractal::deep`.
//
// Points are offsets from the anchor in units of the scale s, and so are distances; derivatives are
// in units of 1 / s, so that nothing overflows.

// Whether this pipeline is for views that are drawn from an anchor.
override DEEP: bool = false;

// How many steps of the difference all orbits near the anchor take together, up to `MOST_NEAR_STEPS`; 0
// where each orbit is followed by itself.
override NEAR_STEPS: u32 = 2u;
// Whether a polynomial stands for the steps before those. Else they are the orbit's first.
override HAS_SKIP: bool = true;
// Whether a ray steps by the stretch of its own direction, rather than by a product of bounds.
override FOLLOWS_DIRECTION: bool = DEEP && (HAS_SKIP || NEAR_STEPS == 0u);

// A difference is followed by itself while it is smaller than this part of the place:
// `fractal::deep::CLOSE`.
const CLOSE = 0.01;

// How far from the anchor points may be that skip the most steps, in scales, and from each radius to
// the next: `render::uniforms::depth`.
const FIRST_RADIUS = 12.0;
const RADII_RATIO = 8.0;

// An orbit under way.
struct Walk {
    // Where it is.
    z: vec3f,
    // How many steps it has gone.
    count: u32,
    // Its difference to a place of the reference, and that place's index. Of deep views only.
    difference: vec3f,
    index: u32,
}

// Which of the skips is for a point; `SKIPS` where it has to take every step.
fn skip_of(point: vec3f) -> u32 {
    let radii = log2(dot(point, point) / (FIRST_RADIUS * FIRST_RADIUS)) / (2.0 * log2(RADII_RATIO));
    return u32(clamp(ceil(radii), 0.0, f32(SKIPS)));
}

// Whether a point's orbit takes the steps that the picture itself holds.
fn is_near(point: vec3f) -> bool {
    return dot(point, point) < picture.fractal.near_radius_squared;
}

// Whether plain f32 tells a point from its neighbours: its pixel is wide enough.
fn is_far(point: vec3f) -> bool {
    // Its square may be past what an f32 holds.
    return max(max(abs(point.x), abs(point.y)), abs(point.z)) > picture.fractal.far_radius;
}

// Behind the steps that are skipped.
fn skipped_walk(skip: Skip, place: vec3f, point: vec3f) -> Walk {
    // The mean of the Jacobians at the anchor and at the point: of a second-order polynomial.
    let at_anchor = mat3x3f(skip.along_x, skip.along_y, skip.along_z);
    let difference = 0.5 * ((at_anchor + skipped_jacobian(skip, point)) * point);
    return Walk(place + difference, skip.steps, difference, skip.steps);
}

// The same of a skip that the picture does not hold.
fn far_walk(which: u32, point: vec3f) -> Walk {
    return skipped_walk(anchor_orbit.skips[which], anchor_orbit.places[anchor_orbit.skips[which].steps].z, point);
}

// The derivative after those steps.
fn skipped_derivative(skip: Skip, point: vec3f) -> f32 {
    return skip.derivative + dot(skip.derivative_gradient, point);
}

fn skipped_growth(fractal: Fractal, skip: Skip, point: vec3f, along: vec3f, which: u32) -> Growth {
    let jacobian = skipped_jacobian(skip, point);
    let stretched = jacobian * along;
    // Of directions across the widest; from farther away it would be followed over too many steps.
    var bound = select(0.0, skip.rest, which < 2u);
    if (!FOLLOWS_DIRECTION) { bound = length(jacobian * skip.widest); }
    let dg = bound / step_factor(fractal);
    return Growth(skipped_derivative(skip, point), dg, stretched, skip.rest / skip.derivative);
}

// Whether the next step is one of the difference.
fn is_close(walk: Walk, q: Squares) -> bool {
    let next = walk.index + 1u;
    let goes_on = (next != picture.fractal.own_places) & (next < picture.fractal.places);
    // Squares of tiny differences are 0, which is what they are meant to be here.
    return goes_on & (dot(walk.difference, walk.difference) < CLOSE * CLOSE * q.s);
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
fn deviation(place: Place, aside: vec2f, rho: f32) -> Deviation {
    let inverse_rho = 1.0 / max(rho, 1e-37);
    let inverse_sum = 1.0 / max(rho + place.rho, 1e-37);
    let along = dot(place.rotor, aside);
    let d_rho = 2.0 * (place.rho * inverse_sum) * along + dot(aside, inverse_sum * aside);
    // On the axis the rotor is 1.
    let turned = inverse_rho * (aside - d_rho * place.rotor);
    let d_rotor = select(vec2f(1.0, 0.0) - place.rotor, turned, rho > 0.0);
    return Deviation(d_rho, d_rotor, inverse_rho);
}

// One step of the difference to `place`, where the orbit itself is `rho` from the axis.
fn raised_close(fractal: Fractal, walk: Walk, place: Place, rho: f32, q: Squares) -> Raised {
    let d = deviation(place, walk.difference.xy, rho);
    let w = pair_power(Pair(vec2f(place.rho, place.z.z), vec2f(d.rho, walk.difference.z)), POWER);
    let u = pair_power(Pair(place.rotor, d.rotor), POWER);
    let wn = w.value + w.difference;
    let un = u.value + u.difference;
    let across = w.value.x * u.difference + w.difference.x * un;
    let power = vec3f(across, fractal.z_sign * w.difference.y);
    return Raised(power, stretch_whole(fractal, q), d.inverse_rho, un, wn);
}

// The same to a place of the reference. It also holds where the square of rho is too small for an f32.
fn raised_next(fractal: Fractal, walk: Walk, q: Squares) -> Raised {
    return raised_close(fractal, walk, anchor_orbit.places[walk.index], length_of(walk.z.xy), q);
}

// Goes on by such a step.
fn step_close(walk: Walk, step: Raised, orbit: Orbit) -> Walk {
    return step_to(walk, anchor_orbit.places[walk.index + 1u].z, step, orbit);
}

// The same to a place that is known.
fn step_to(walk: Walk, place: vec3f, step: Raised, orbit: Orbit) -> Walk {
    let difference = step.power + orbit.added;
    return Walk(place + difference, walk.count + 1u, difference, walk.index + 1u);
}

// Goes on from z^n: its difference to where orbits start anew (rebasing).
fn step_anew(walk: Walk, power: vec3f, orbit: Orbit) -> Walk {
    let difference = power + orbit.added;
    let z = orbit.constant + difference;
    return Walk(z, walk.count + 1u, difference, picture.fractal.restart);
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

// The tangent behind the steps that are skipped.
fn skipped_tangent(skip: Skip, orbit: Orbit, point: vec3f) -> Tangent {
    let inverse = 1.0 / skipped_derivative(skip, point);
    return Tangent(
        inverse * skipped_jacobian(skip, point),
        (inverse * inverse) * skip.derivative_gradient,
        inverse * orbit.constant_derivative,
    );
}

// The Jacobian behind them.
fn skipped_jacobian(skip: Skip, point: vec3f) -> mat3x3f {
    return mat3x3f(
        skip.along_x + point.x * skip.along_xx + point.y * skip.along_xy + point.z * skip.along_zx,
        skip.along_y + point.y * skip.along_yy + point.z * skip.along_yz + point.x * skip.along_xy,
        skip.along_z + point.z * skip.along_zz + point.x * skip.along_zx + point.y * skip.along_yz,
    );
}
