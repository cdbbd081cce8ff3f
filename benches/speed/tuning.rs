//! The kindest honest settings of the literal kernel, found for each view in f64.
//!
//! Epsilon is the pixel's footprint (its cone's radius) at the view's median hit. Iterations are
//! the fewest with which the picture at that epsilon is the one of [`PLENTY`] iterations: no more
//! than [`HITS_DIFFER`] of the pixels change between hit and miss, and [`DEPTHS_AGREE`] of the
//! depths move by less than one footprint.

use glam::DVec3;
use mandelight::{
    fractal::{DistanceField, Estimator, Ray},
    scene::Scene,
};

use super::{
    literal::Tuning,
    pixels::{footprint, pixel_ray, spread, with_iterations},
    statistics,
};

/// The cap on a ray's steps.
const STEPS: u32 = 400;
/// More iterations than any view here needs.
const PLENTY: u32 = 100;
/// Part of the pixels that may change between hit and miss.
const HITS_DIFFER: f64 = 0.002;
/// Part of the depths that have to be within a footprint.
const DEPTHS_AGREE: f64 = 0.99;
/// About how many pixels are looked at.
const PIXELS: u32 = 4000;

/// As `march` in `literal.wgsl`, in f64.
fn march(estimator: &Estimator, ray: Ray, divergence: f64, epsilon: f64) -> Option<f64> {
    let mut t = 0.0;
    for _ in 0..STEPS {
        let point: DVec3 = ray.at(t);
        if point.length() > divergence && point.dot(ray.direction) > 0.0 {
            return None;
        }
        let d = estimator.distance(point);
        if d < epsilon {
            return Some(t);
        }
        t += d;
    }
    Some(t)
}

/// Finds them.
pub fn find(scene: &Scene, size_px: [u32; 2]) -> Tuning {
    let pixels = spread(size_px, PIXELS);
    let cone = footprint(scene, size_px);
    let plenty = with_iterations(&scene.fractal, PLENTY);
    let depths = statistics::in_parallel(&pixels, |&pixel| {
        plenty.march(pixel_ray(scene, size_px, pixel), cone, f64::INFINITY)
    });
    let epsilon = cone * statistics::quantile(depths.into_iter().flatten().collect(), 0.5);
    let seen = |iterations: u32| {
        let estimator = with_iterations(&scene.fractal, iterations);
        statistics::in_parallel(&pixels, |&pixel| {
            march(&estimator, pixel_ray(scene, size_px, pixel), scene.fractal.bailout, epsilon)
        })
    };
    let goal = seen(PLENTY);
    let suffices = |iterations: &u32| {
        let both: Vec<_> = seen(*iterations).into_iter().zip(&goal).collect();
        let differ = both.iter().filter(|(a, b)| a.is_some() != b.is_some()).count();
        let moved: Vec<_> = both.iter().filter_map(|(a, b)| Some(((*a)? - (**b)?).abs())).collect();
        differ as f64 <= HITS_DIFFER * both.len() as f64
            && statistics::quantile(moved, DEPTHS_AGREE) < epsilon
    };
    let iterations = (2..PLENTY).find(suffices).unwrap_or(PLENTY);
    Tuning { epsilon, iterations, steps: STEPS }
}
