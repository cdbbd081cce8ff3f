// Orbits of even powers close to the polar axis, in a frame that rotates with the point's longitude, and
// their derivatives. Host twins, with the equations: `deep/{rotating_frame, jacobian}.rs`.
// uses: lib/complex

const MIXES_STEPS = false;

// (1 + v)(1 + w) - 1.
fn ahead_product(v: vec2f, w: vec2f) -> vec2f {
    return v + w + complex_product(v, w);
}

// Normalises the rotor 1 + v: rounding changes its length, and each step multiplies the error by n.
fn ahead_normalized(v: vec2f) -> vec2f {
    let excess = 2.0 * v.x + dot(v, v);
    let length = sqrt(max(1.0 + excess, 1e-30));
    return (v - vec2f(excess / (1.0 + length), 0.0)) / length;
}

// The rotor's square, times w if the exponent's next bit is set, minus 1.
fn ahead_power_bit(v: vec2f, w: vec2f, bit: u32) -> vec2f {
    let squared = ahead_product(v, v);
    if (bit != 0u) { return ahead_product(squared, w); }
    return squared;
}

// The rotor's n-th power, minus 1, for even n from 2 to 16. Unrolled: an invocation may take only a
// limited number of loop turns.
fn ahead_power(w: vec2f) -> vec2f {
    var v = w;
    if (POWER >= 16u) { v = ahead_product(v, v); }
    if (POWER >= 8u) { v = ahead_power_bit(v, w, POWER & 4u); }
    if (POWER >= 4u) { v = ahead_power_bit(v, w, POWER & 2u); }
    return ahead_normalized(ahead_product(v, v));
}

// Derivatives of an orbit by its point; the Jacobian ignores longitudes.
struct Motion {
    dr: f32,
    // Over dr.
    jacobian: mat3x3f,
    // The gradient of the angle by which the constant rotates back.
    turn: vec3f,
    // The gradient of dr over dr^2.
    slope: vec3f,
}

// An orbit in progress.
struct Walk {
    state: OrbitState,
    q: Squares,
    motion: Motion,
    // The frame's rotor, minus 1.
    ahead: vec2f,
    // Least distances from the colour layers' traps, which rotate with the frame.
    traps: vec2f,
}

struct OrbitState {
    z: vec3f,
    // Number of steps taken.
    count: u32,
    // Difference to a reference point on the point's meridian, and that point's index.
    difference: vec3f,
    index: u32,
}

// The motion after another step, from `z`, at distance `rho` from the axis toward `u`. In the new frame
// fixed directions are rotated by `rotor`.
fn moved_on(
    fractal: Fractal, orbit: Orbit, before: Motion, step: Raised, z: vec3f, q: Squares,
    rho: f32, u: vec2f, rotor: vec2f,
) -> Motion {
    let dr_before = min(before.dr, fractal.derivative_max);
    let dr = step.stretch * dr_before + orbit.constant_derivative;
    let inverse = 1.0 / max(dr, 1e-37);
    let shrink = dr_before * inverse;
    let j = before.jacobian;
    // Gradient of the longitude by the point.
    let by_rho = min(dr_before * min(1.0 / max(rho, 1e-37), 1e6 / fractal.scale), 1e30);
    let turn = fractal.power * (before.turn + by_rho * (vec3f(-u.y, u.x, 0.0) * j));
    // Ripples finer than some pixels are lower than a pixel if the axis is in view.
    let finest = 0.5 / frame.camera.hit_cone;
    let most = finest * clamp(anchor_orbit.points[0].rho / fractal.scale, 1.0, 1e9);
    // Coordinates instead of the length, whose square overflows from 1e-20 on.
    let size = max(max(abs(turn.x), abs(turn.y)), max(abs(turn.z), 1e-37));
    let capped = turn * min(1.0, most / (size * length(turn / size)));
    let constant = orbit.constant + orbit.added;
    let around = complex_product(vec2f(-constant.y, constant.x), rotor);
    let own = inverse * orbit.constant_derivative;
    let m = (shrink * fractal.power / max(q.s, 1e-18)) * complex_product(step.wn, vec2f(rho, -z.z));
    let raised = Meridian(u, m, step.un, fractal.z_sign);
    let jacobian = mat3x3f(
        raised_along(raised, j[0]) + vec3f(own * rotor, 0.0),
        raised_along(raised, j[1]) + vec3f(own * vec2f(-rotor.y, rotor.x), 0.0),
        raised_along(raised, j[2]) + vec3f(0.0, 0.0, own),
    );
    let back = -inverse * capped;
    let whole = jacobian + mat3x3f(
        vec3f(back.x * around, 0.0), vec3f(back.y * around, 0.0), vec3f(back.z * around, 0.0),
    );
    let along = (fractal.power - 1.0) / max(q.s, 1e-18) * (z * j);
    let slope = (step.stretch * shrink * shrink) * (along + before.slope);
    return Motion(dr, whole, capped, slope);
}

fn begin_walk(gathers: u32, fractal: Fractal, orbit: Orbit, point: vec3f, along: vec3f) -> Walk {
    let reference = anchor_orbit.points[0];
    let start = settled(reference, orbit.start_derivative * point);
    let z = reference.z + start.difference;
    let state = OrbitState(z, 0u, start.difference, 0u);
    return Walk(state, squares(z), first_motion(orbit, start.by), start.by, vec2f(MAX_TRAP));
}

// Perturbed steps include the plain ones: the frame rotates in both.
fn is_perturbed(fractal: Fractal, walk: Walk) -> bool {
    return true;
}

fn plain_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    return walk;
}

fn perturbed_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    let difference = walk.state.difference;
    let reference = anchor_orbit.points[walk.state.index];
    var z = walk.state.z;
    let q = walk.q;
    var index = walk.state.index;
    var ahead = ahead_power(walk.ahead);
    let back = vec2f(ahead.x, -ahead.y);
    let rotor = vec2f(1.0, 0.0) + back;
    let aside = complex_product(orbit.added.xy, rotor) + complex_product(orbit.constant.xy, back);
    var rho = length_of(z.xy);
    var u = reference.rotor;
    var step: Raised;
    let has_next = (index + 1u != fractal.own_points) & (index + 1u < fractal.reference_points);
    if (has_next & (dot(difference, difference) < CLOSE * CLOSE * q.s)) {
        step = raised_on_meridian(fractal, reference, difference, q);
        index += 1u;
    } else {
        // Keeps squares above the least f32.
        if (rho < 1e-9) { z = vec3f(1e-9, 0.0, z.z); rho = 1e-9; }
        u = z.xy / rho;
        step = raised(fractal, z, squares(z));
        index = fractal.restart;
    }
    var motion = moved_on(fractal, orbit, walk.motion, step, z, q, rho, u, rotor);
    let next_reference = anchor_orbit.points[index];
    let next = settled(next_reference, step.power + vec3f(aside, orbit.added.z));
    ahead = ahead_normalized(ahead_product(ahead, next.by));
    motion.jacobian = turned_back(motion.jacobian, next.by);
    let next_z = next_reference.z + next.difference;
    let next_q = squares(next_z);
    let state = OrbitState(next_z, walk.state.count + 1u, next.difference, index);
    return Walk(state, next_q, motion, ahead, nearer_traps(walk.traps, next_z));
}

fn first_motion(orbit: Orbit, ahead: vec2f) -> Motion {
    let identity = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    return Motion(orbit.start_derivative, turned_back(identity, ahead), vec3f(0.0), vec3f(0.0));
}

// The columns of `j` rotated back about the axis by the rotor 1 + `by`.
fn turned_back(j: mat3x3f, by: vec2f) -> mat3x3f {
    let back = vec2f(1.0 + by.x, -by.y);
    return mat3x3f(
        vec3f(complex_product(j[0].xy, back), j[0].z),
        vec3f(complex_product(j[1].xy, back), j[1].z),
        vec3f(complex_product(j[2].xy, back), j[2].z),
    );
}

// A difference on its reference point's meridian, and the rotor, minus 1, by which the frame was rotated
// to bring it there.
struct Settled {
    difference: vec3f,
    by: vec2f,
}

fn settled(reference: ReferencePoint, difference: vec3f) -> Settled {
    let d = deviation(reference, difference.xy, length_of(reference.z.xy + difference.xy));
    let by = complex_product(d.rotor, vec2f(reference.rotor.x, -reference.rotor.y));
    return Settled(vec3f(d.rho * reference.rotor, difference.z), ahead_normalized(by));
}

// One step of a difference on its reference point's meridian.
fn raised_on_meridian(fractal: Fractal, reference: ReferencePoint, difference: vec3f, q: Squares) -> Raised {
    let aside = vec2f(dot(reference.rotor, difference.xy), difference.z);
    let w = pair_power(Pair(vec2f(reference.rho, reference.z.z), aside), POWER);
    // The power is even.
    let un = complex_power(complex_square(reference.rotor), POWER / 2u);
    let power = vec3f(w.difference.x * un, fractal.z_sign * w.difference.y);
    return Raised(power, stretch_whole(fractal, q), 0.0, un, w.value + w.difference);
}

fn end_estimate(fractal: Fractal, walk: Walk) -> Estimate {
    let height = height_of(fractal, walk.q);
    if (height <= 0.0) { return Estimate(0.0, 0.0); }
    let distance = height / max(walk.motion.dr, 1e-37);
    let j = walk.motion.jacobian;
    let norm = sqrt(dot(j[0], j[0]) + dot(j[1], j[1]) + dot(j[2], j[2]));
    return Estimate(distance, min(distance / max(norm, 1.0), fractal.max_step));
}

fn end_gradient(fractal: Fractal, walk: Walk) -> vec3f {
    return gradient_at(fractal, walk.state.z, walk.q, walk.motion.jacobian, walk.motion.slope);
}

fn end_traps(walk: Walk) -> vec2f {
    return walk.traps;
}

// The quick estimate is exact.
fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return estimate(fractal, point, along);
}

// Never called: the quick estimate is exact.
fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return Estimate(0.0, 0.0);
}

// The direction that stands for all rays of a cone: zero, since steps do not depend on it.
fn cone_direction() -> vec3f {
    return vec3f(0.0);
}
