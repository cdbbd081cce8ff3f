// The difference between an orbit and the reference orbit, which f32 can follow at any depth. Host twin,
// with the equations: `deep/difference.rs`.
//
// Points and distances are in units of the scale s, points relative to the anchor; derivatives are
// in units of 1 / s, so that nothing overflows.
// uses: lib/complex

// Orbits take perturbed steps while the difference is below this part of |z|: `deep::CLOSE`.
const CLOSE = 0.01;

// A complex number, and the difference of another number to it.
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

// Factors that bring lengths of about `size` near 1 and back, so that products of two or more lengths stay in an
// f32's range: GPUs take numbers below 1.2e-38 for 0, and their compilers may multiply in another order than the one
// that is written.
struct Magnification {
    up: f32,
    down: f32,
}

fn magnification(size: f32) -> Magnification {
    let is_tiny = size < 1e-15;
    return Magnification(select(1.0, 1e18, is_tiny), select(1.0, 1e-18, is_tiny));
}

// |v|, even if the square of |v| is too small for an f32.
fn length_of(v: vec2f) -> f32 {
    let by = magnification(max(abs(v.x), abs(v.y)));
    return length(by.up * v) * by.down;
}

// Differences of an orbit's rho and rotor to those of a reference point.
struct Deviation {
    rho: f32,
    rotor: vec2f,
    // One over the orbit's own rho.
    inverse_rho: f32,
}

// `aside`: the difference across the axis, no longer than both rho together; `rho`: the orbit's own rho.
fn deviation(reference: ReferencePoint, aside: vec2f, rho: f32) -> Deviation {
    let by = magnification(rho + reference.rho);
    let inverse_rho = 1.0 / max(by.up * rho, 1e-19);
    let inverse_sum = 1.0 / max(by.up * (rho + reference.rho), 1e-19);
    let offset = by.up * aside;
    let along = dot(reference.rotor, offset);
    let d_rho = 2.0 * (by.up * reference.rho * inverse_sum) * along + dot(offset, inverse_sum * offset);
    // On the axis the rotor is 1.
    let turned = inverse_rho * (offset - d_rho * reference.rotor);
    let d_rotor = select(vec2f(1.0, 0.0) - reference.rotor, turned, rho > 0.0);
    return Deviation(by.down * d_rho, d_rotor, by.up * inverse_rho);
}

// The orbit of a point given as its offset from the anchor.
fn orbit_of(fractal: Fractal, point: vec3f) -> Orbit {
    let julia = fractal.julia != 0u;
    let offset = fractal.scale * point;
    return Orbit(
        fractal.anchor + offset,
        select(fractal.anchor, fractal.julia_constant, julia),
        select(offset, vec3f(0.0), julia),
        select(fractal.scale, 0.0, julia),
        fractal.scale,
        fractal.bailout * fractal.bailout,
    );
}

// Offset from the polar axis of plain steps in views about an anchor.
const BESIDE_AXIS = vec3f(1e-9, 1e-16, 0.0);
