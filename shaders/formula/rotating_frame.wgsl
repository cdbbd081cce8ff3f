// Orbits of even powers hard by the polar axis, in a frame that turns with their point's longitude,
// and how they move with the point. Host twins, with the equations: `fractal::deep::{rotating_frame, jacobian}`.

// True in pipelines of deep views whose anchor is close to the polar axis.
override ROTATING_FRAME: bool = false;

// (1 + v)(1 + w) - 1.
fn ahead_product(v: vec2f, w: vec2f) -> vec2f {
    return v + w + complex_product(v, w);
}

// Rounding makes the rotor 1 + v longer or shorter, and each step n times as much.
fn ahead_normalized(v: vec2f) -> vec2f {
    let excess = 2.0 * v.x + dot(v, v);
    let length = sqrt(max(1.0 + excess, 1e-30));
    return (v - vec2f(excess / (1.0 + length), 0.0)) / length;
}

// The rotor's square, times w where the exponent's next bit is set, less 1.
fn ahead_power_bit(v: vec2f, w: vec2f, bit: u32) -> vec2f {
    let squared = ahead_product(v, v);
    if (bit != 0u) { return ahead_product(squared, w); }
    return squared;
}

// The rotor's n-th power, less 1, for even n from 2 to 16. No loop: invocations have only so many
// turns of loops.
fn ahead_power(w: vec2f) -> vec2f {
    var v = w;
    if (POWER >= 16u) { v = ahead_product(v, v); }
    if (POWER >= 8u) { v = ahead_power_bit(v, w, POWER & 4u); }
    if (POWER >= 4u) { v = ahead_power_bit(v, w, POWER & 2u); }
    return ahead_normalized(ahead_product(v, v));
}

// How an orbit moves with its point, were it not for longitudes.
struct Motion {
    dr: f32,
    // Over dr.
    jacobian: mat3x3f,
    // The gradient of the angle by which the constant turns back.
    turn: vec3f,
    // The gradient of dr over dr^2.
    slope: vec3f,
}

// An orbit's end.
struct RotatingEnd {
    z: vec3f,
    q: Squares,
    count: u32,
    motion: Motion,
    // Squared least distances from the origin, the z axis and the plane z = 0.
    traps: vec3f,
}

// The motion after another step, from `z` that is `rho` beside the axis toward `u`, to a frame in
// which fixed directions are turned by `rotor`.
fn moved_on(
    fractal: Fractal, orbit: Orbit, before: Motion, step: Raised, z: vec3f, q: Squares,
    rho: f32, u: vec2f, rotor: vec2f,
) -> Motion {
    let dr_before = min(before.dr, fractal.derivative_max);
    let dr = step.stretch * dr_before + orbit.constant_derivative;
    let inverse = 1.0 / max(dr, 1e-37);
    let shrink = dr_before * inverse;
    let j = before.jacobian;
    // How the longitude moves with the point.
    let by_rho = dr_before * min(1.0 / max(rho, 1e-37), 1e6 / fractal.scale);
    let turn = fractal.power * (before.turn + by_rho * (vec3f(-u.y, u.x, 0.0) * j));
    // Ripples that are finer than some pixels are lower than one, where the axis is in view.
    let finest = 0.5 / frame.camera.hit_cone;
    let most = finest * clamp(anchor_orbit.points[0].rho / fractal.scale, 1.0, 1e9);
    let capped = turn * min(1.0, most / max(length(turn), 1e-37));
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

// Where an orbit gets to.
fn rotating_end(fractal: Fractal, point: vec3f) -> RotatingEnd {
    let orbit = orbit_of(fractal, point);
    var reference = anchor_orbit.points[0];
    let start = settled(reference, orbit.start_derivative * point);
    var index = 0u;
    var count = 0u;
    var difference = start.difference;
    var z = reference.z + difference;
    var q = squares(z);
    var ahead = start.by;
    var motion = first_motion(orbit, ahead);
    var traps = vec3f(4.0);
    for (; q.s <= orbit.limit && count < fractal.iterations; ) {
        ahead = ahead_power(ahead);
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
            // Where squares would be too small.
            if (rho < 1e-9) { z = vec3f(1e-9, 0.0, z.z); rho = 1e-9; }
            u = z.xy / rho;
            step = raised(fractal, z, squares(z));
            index = fractal.restart;
        }
        motion = moved_on(fractal, orbit, motion, step, z, q, rho, u, rotor);
        reference = anchor_orbit.points[index];
        let next = settled(reference, step.power + vec3f(aside, orbit.added.z));
        ahead = ahead_normalized(ahead_product(ahead, next.by));
        motion.jacobian = turned_back(motion.jacobian, next.by);
        difference = next.difference;
        z = reference.z + difference;
        count += 1u;
        q = squares(z);
        traps = min(traps, vec3f(q.s, q.a, q.zz));
    }
    return RotatingEnd(z, q, count, motion, traps);
}

fn first_motion(orbit: Orbit, ahead: vec2f) -> Motion {
    let identity = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    return Motion(orbit.start_derivative, turned_back(identity, ahead), vec3f(0.0), vec3f(0.0));
}

// The columns of `j` turned back about the axis by the rotor that is `by` more than 1.
fn turned_back(j: mat3x3f, by: vec2f) -> mat3x3f {
    let back = vec2f(1.0 + by.x, -by.y);
    return mat3x3f(
        vec3f(complex_product(j[0].xy, back), j[0].z),
        vec3f(complex_product(j[1].xy, back), j[1].z),
        vec3f(complex_product(j[2].xy, back), j[2].z),
    );
}

// A difference in a frame in which it is on its place's meridian, and what the rotor that the frame
// has been turned by for that is more than 1.
struct Settled {
    difference: vec3f,
    by: vec2f,
}

fn settled(reference: ReferencePoint, difference: vec3f) -> Settled {
    let d = deviation(reference, difference.xy, length_of(reference.z.xy + difference.xy));
    let by = complex_product(d.rotor, vec2f(reference.rotor.x, -reference.rotor.y));
    return Settled(vec3f(d.rho * reference.rotor, difference.z), ahead_normalized(by));
}

// A step of a difference on its place's meridian.
fn raised_on_meridian(fractal: Fractal, reference: ReferencePoint, difference: vec3f, q: Squares) -> Raised {
    let aside = vec2f(dot(reference.rotor, difference.xy), difference.z);
    let w = pair_power(Pair(vec2f(reference.rho, reference.z.z), aside), POWER);
    // An even power.
    let un = complex_power(complex_square(reference.rotor), POWER / 2u);
    let power = vec3f(w.difference.x * un, fractal.z_sign * w.difference.y);
    return Raised(power, stretch_whole(fractal, q), 0.0, un, w.value + w.difference);
}

fn rotating_estimate(fractal: Fractal, point: vec3f) -> Estimate {
    let end = rotating_end(fractal, point);
    if (end.q.s <= 1.0) { return Estimate(0.0, 0.0); }
    let distance = height_of(end.q) / max(end.motion.dr, 1e-37);
    let j = end.motion.jacobian;
    let norm = sqrt(dot(j[0], j[0]) + dot(j[1], j[1]) + dot(j[2], j[2]));
    return Estimate(distance, min(distance / max(norm, 1.0), fractal.max_step));
}

fn rotating_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    let end = rotating_end(fractal, point);
    if (end.q.s <= 1.0) { return vec3f(0.0); }
    return gradient_at(end.z, end.q, end.motion.jacobian, end.motion.slope);
}
