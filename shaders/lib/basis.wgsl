// Directions in the frame of a surface.

const PI = 3.14159265;

// Two unit vectors at right angles to a unit vector and to each other
// (T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017).
struct Basis {
    x: vec3f,
    y: vec3f,
}

fn basis(n: vec3f) -> Basis {
    let sign = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    return Basis(
        vec3f(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        vec3f(b, sign + n.y * n.y * a, -n.y));
}

// The direction with these coordinates in the frame of `n`, whose third axis is `n`.
fn from_local(n: vec3f, local: vec3f) -> vec3f {
    let b = basis(n);
    return local.x * b.x + local.y * b.y + local.z * n;
}

// The direction at an angle to `n`, of this sine and cosine, and turned about `n` by `turn`: 0 to 1 for all around.
fn from_polar(n: vec3f, sine: f32, cosine: f32, turn: f32) -> vec3f {
    // From -pi to pi, where WGSL's functions are exact.
    let azimuth = 2.0 * PI * (turn - 0.5);
    return from_local(n, vec3f(sine * cos(azimuth), sine * sin(azimuth), cosine));
}
