//! Directional albedo of a GGX lobe, by roughness and cosine.
//!
//! In: nothing. Out: a table by roughness and cosine, for `shaders/lib/bsdf.wgsl`.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

/// Entries along each side of the table: `ALBEDO_ENTRIES` in the shader.
pub const ALBEDO_ENTRIES: usize = 32;

/// Least squared roughness: `MIN_ALPHA` in `shaders/lib/material.wgsl`.
const MIN_ALPHA: f64 = 1e-3;

/// Points of the quadrature, and the step between two of them in azimuth: Fibonacci numbers.
///
/// Light that is lost below the horizon is a narrow strip of the directions, which a grid of as many points misses.
const LATTICE: [u32; 2] = [2584, 1597];

/// Rows by the square root of alpha, columns by the square root of the cosine, both from 0 to 1.
///
/// An entry `[x, y]` says: with a reflectance F0 at normal incidence the albedo is F0 x + y, single scattering only.
pub static ALBEDO_TABLE: LazyLock<Vec<[f32; 2]>> = LazyLock::new(|| {
    let last = (ALBEDO_ENTRIES - 1) as f64;
    let at = |index: usize| (index as f64 / last).powi(2);
    (0..ALBEDO_ENTRIES * ALBEDO_ENTRIES)
        .map(|i| {
            let [column, row] = [i % ALBEDO_ENTRIES, i / ALBEDO_ENTRIES];
            albedo(at(column).max(1e-4), at(row).max(MIN_ALPHA)).as_vec2().to_array()
        })
        .collect()
});

/// The albedo at a cosine, over reflected directions of normals that the viewer sees.
///
/// J. Dupuy, A. Benyoub, Sampling Visible GGX Normals with Spherical Caps (CGF 42(8), 2023).
fn albedo(cosine: f64, alpha: f64) -> DVec2 {
    let viewer = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let stretched = (viewer * DVec3::new(alpha, alpha, 1.0)).normalize();
    let slope = |cosine: f64| (alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine).sqrt();
    let mut sum = DVec2::ZERO;
    let [count, step] = LATTICE;
    for k in 0..count {
        let turn = (f64::from(k * step % count) + 0.5) / f64::from(count);
        let azimuth = turn * std::f64::consts::PI;
        let z = 1.0 - (f64::from(k) + 0.5) / f64::from(count) * (1.0 + stretched.z);
        let sin_theta = (1.0 - z * z).max(0.0).sqrt();
        let h = DVec3::new(sin_theta * azimuth.cos(), sin_theta * azimuth.sin(), z) + stretched;
        let normal = (h * DVec3::new(alpha, alpha, 1.0)).normalize();
        let toward = viewer.dot(normal);
        let light = 2.0 * toward * normal.z - cosine;
        if light <= 0.0 {
            continue;
        }
        // The lobe's value over the density of the direction.
        let weight =
            light * (cosine + slope(cosine)) / (light * slope(cosine) + cosine * slope(light));
        let grazing = (1.0 - toward.clamp(0.0, 1.0)).powi(5);
        sum += weight * DVec2::new(1.0 - grazing, grazing);
    }
    sum / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirrors_reflect_all_light_and_rough_surfaces_lose_some() {
        // A mirror's albedo is Schlick's Fresnel.
        for cosine in [0.1, 0.5, 1.0] {
            let found = albedo(cosine, MIN_ALPHA);
            let grazing = (1.0_f64 - cosine).powi(5);
            assert!((found.x + found.y - 1.0).abs() < 1e-3, "{cosine}: {found}");
            assert!((found.y - grazing).abs() < 2e-3, "{cosine}: {found}");
        }
        // By a lattice of a million points.
        let satin = albedo(0.7, 0.09);
        assert!((satin.x + satin.y - 0.9851).abs() < 5e-4, "{satin}");
        // C. Kulla and A. Conty, Revisiting Physically Based Shading at Imageworks (2017): about half at full roughness.
        let rough = albedo(1.0, 1.0);
        assert!((0.3..0.7).contains(&(rough.x + rough.y)), "{rough}");
        assert!(ALBEDO_TABLE.iter().all(|[x, y]| *x >= 0.0 && *y >= 0.0 && x + y < 1.0 + 1e-3));
    }
}
