//! Folds, turns and powers that several formulas share, and their parameters.

use glam::{DQuat, DVec3, DVec4, Vec3Swizzles as _};
use mandelight::formula::{Fractal, table::Value};

/// The number called `name`.
pub fn number(fractal: &Fractal, name: &str) -> f64 {
    fractal.number(name).unwrap_or_else(|| panic!("no number {name}"))
}

/// The vector called `name`.
pub fn vector(fractal: &Fractal, name: &str) -> Vec<f64> {
    match fractal.get(name) {
        Some(Value::Vector(numbers)) => numbers.to_vec(),
        other => panic!("{name} is {other:?}"),
    }
}

/// The vector of three components called `name`.
pub fn vec3(fractal: &Fractal, name: &str) -> DVec3 {
    DVec3::from_slice(&vector(fractal, name))
}

/// The Julia form's constant, if `fractal` has that form.
pub fn julia_constant(fractal: &Fractal) -> Option<DVec4> {
    fractal.is_on("julia").then(|| {
        let mut all = vector(fractal, "julia_constant");
        all.resize(4, 0.0);
        DVec4::from_slice(&all)
    })
}

/// Turned by degrees about x, then y, then z.
pub fn turned(fractal: &Fractal, z: DVec3) -> DVec3 {
    let [x, y, w] = vec3(fractal, "rotation").to_array().map(f64::to_radians);
    DQuat::from_rotation_z(w) * (DQuat::from_rotation_y(y) * (DQuat::from_rotation_x(x) * z))
}

/// rⁿ at n times the longitude and latitude.
pub fn triplex(z: DVec3, n: f64) -> DVec3 {
    let r = z.length();
    let (theta, phi) = (z.y.atan2(z.x), z.z.atan2(z.xy().length()));
    let (theta, phi) = (n * theta, n * phi);
    r.powf(n) * DVec3::new(phi.cos() * theta.cos(), phi.cos() * theta.sin(), phi.sin())
}

/// Mirrored at ±`limit`.
pub fn folded(x: f64, limit: f64) -> f64 {
    if x > limit {
        2.0 * limit - x
    } else if x < -limit {
        -2.0 * limit - x
    } else {
        x
    }
}

/// Each component mirrored at its limit.
pub fn box_folded(z: DVec3, limits: DVec3) -> DVec3 {
    DVec3::new(folded(z.x, limits.x), folded(z.y, limits.y), folded(z.z, limits.z))
}

/// The factor of the sphere fold.
pub fn sphere_factor(z: DVec3, inner: f64, outer: f64) -> f64 {
    let r2 = z.length_squared();
    if r2 < inner * inner {
        (outer / inner).powi(2)
    } else if r2 < outer * outer {
        outer * outer / r2
    } else {
        1.0
    }
}

/// Mirrored at the plane through the origin, if behind it.
pub fn mirrored(z: DVec3, normal: DVec3) -> DVec3 {
    let height = z.dot(normal);
    if height < 0.0 { z - 2.0 * height * normal } else { z }
}

/// The components, largest first.
pub fn sorted(z: DVec3) -> DVec3 {
    let mut all = z.to_array();
    all.sort_by(|a, b| b.total_cmp(a));
    DVec3::from_array(all)
}

/// Distance to the cube of half size 1; negative inside.
pub fn cube(z: DVec3) -> f64 {
    let q = z.abs() - 1.0;
    q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
}

/// Mirrored into the fundamental cell of the tetrahedron's mirrors.
pub fn tetrahedral(z: DVec3) -> DVec3 {
    [(1.0, 1.0, 0.0), (1.0, 0.0, 1.0), (0.0, 1.0, 1.0)]
        .into_iter()
        .fold(z, |z, normal| mirrored(z, DVec3::from(normal).normalize()))
}
