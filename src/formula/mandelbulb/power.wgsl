// The triplex power z^n and its derivatives. Host twin: `power.rs`.
// Thesis Algorithm 1, with atan2(z, rho) for asin(z / r) and, for whole powers, complex powers
// instead of trigonometry:
//     rho = |x + iy|, u = (x + iy) / rho, w = rho + iz
//     z^n = (Re w^n Re u^n, Re w^n Im u^n, Im w^n)
// Roots and divisions cost most, so they come late or not at all: u² and w² need only a = rho²,
// and an even power of w is p + i q rho, where p and q are polynomials of a and z:
//     n = 2 m:      Re w^n = p,             Im w^n = q rho
//     n = 2 m + 1:  Re w^n = (p - z q) rho, Im w^n = a q + z p
// uses: lib/complex, lib/numeric

// The power that this pipeline is specialised for, 2 to 16; 0 reads the power from the uniforms.
override POWER: u32 = 0u;

// Greatest stretch along the parallels that a step adds to dg, over n |z|^(n - 1): uncapped, the stretch
// would stop every ray at the poles; with a lower cap, rays pass walls where all orbits of a view pass the axis.
const SIDEWAYS_MAX = 100.0;
// The cap for the Jacobian of deep views, most of which are far from the poles: with 30, rays passed
// lips that they should hit.
const DEEP_SIDEWAYS_MAX = 300.0;

// Squares that a step starts from.
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

// z^n and the parts of its derivatives. The compiler removes what a caller does not use.
struct Raised {
    power: vec3f,
    // n |z|^(n - 1): the factor of the scalar derivative.
    stretch: f32,
    // One over the distance from the polar axis, rho.
    inverse_rho: f32,
    // Powers of the rotor u and of w.
    un: vec2f,
    wn: vec2f,
}

// u^2m. Divides after computing (x + iy)^4; a higher power would underflow near the axis.
fn rotor_power(q: Squares, inverse_a: f32, m: u32) -> vec2f {
    if (m % 2u == 0u) {
        return complex_power(inverse_a * (inverse_a * complex_square(q.xy)), m / 2u);
    }
    return complex_power(inverse_a * q.xy, m);
}

// n |z|^(n - 1) for the whole power.
fn stretch_whole(fractal: Fractal, q: Squares) -> f32 {
    if (POWER % 2u == 0u) { return (fractal.power * sqrt(q.s)) * real_power(q.s, POWER / 2u - 1u); }
    return fractal.power * real_power(q.s, POWER / 2u);
}

// z^n for the whole power that the pipeline is specialised for.
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

// z^n for a real power, in polar coordinates.
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

fn raised(fractal: Fractal, z: vec3f, q: Squares) -> Raised {
    if (POWER != 0u) { return raised_whole(fractal, z, q); }
    return raised_real(fractal, z, q);
}

// The stretch along the parallels: n Re w^n / rho, at most `most` times n |z|^(n - 1).
fn sideways(fractal: Fractal, step: Raised, most: f32) -> f32 {
    let limit = most * step.stretch;
    return clamp(fractal.power * step.inverse_rho * step.wn.x, -limit, limit);
}

// How a step maps directions in the meridian's plane: rotates the plane from u to un, and scales and
// rotates inside the plane by m.
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

// How a step maps a direction: its Jacobian times `v`, with the stretch along parallels clamped.
fn pushed(fractal: Fractal, step: Raised, z: vec3f, q: Squares, v: vec3f) -> vec3f {
    let u = step.inverse_rho * z.xy;
    let w = vec2f(step.inverse_rho * q.a, -z.z);
    let m = (fractal.power / q.s) * complex_product(step.wn, w);
    let along = raised_along(Meridian(u, m, step.un, fractal.z_sign), v);
    let parallel = sideways(fractal, step, DEEP_SIDEWAYS_MAX) * (u.x * v.y - u.y * v.x);
    return vec3f(along.xy + parallel * vec2f(-step.un.y, step.un.x), along.z);
}

// The Jacobian of z^n: n |z|^(n - 1) times a rotation of the meridian's plane by n - 1 latitudes and of
// the parallels by n - 1 longitudes, with a stretch along the parallels of at most `sideways_max` times
// n |z|^(n - 1). That times w^(n - 1) / |w^(n - 1)| is n w^n conj(w) / |z|^2. `rho`: of z.
fn raised_jacobian(
    fractal: Fractal, step: Raised, z: vec3f, rho: f32, q: Squares, sideways_max: f32,
) -> mat3x3f {
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

fn scaled_identity(scale: f32) -> mat3x3f {
    return mat3x3f(scale, 0.0, 0.0, 0.0, scale, 0.0, 0.0, 0.0, scale);
}
