//! The literal kernel's tuning: the fastest settings for a view that keep its picture.
//!
//! In: a scene and a size. Out: a [`Tuning`], found in f64. Epsilon is the pixel's footprint
//! (its cone's radius) at the view's median hit. The iteration limit is the smallest at which
//! the picture matches that of [`AMPLE_ITERATIONS`]: at most [`MAX_HIT_CHANGES`] of the pixels
//! change between hit and miss, and [`DEPTH_QUANTILE`] of the depths move by less than one
//! footprint.

use glam::DVec3;
use mandelight::{
    formula::{
        DistanceField, Ray,
        mandelbulb::{Mandelbulb, estimator::Estimator},
    },
    scene::Scene,
};

use super::{
    literal::Tuning,
    pixels::{evenly_spaced, footprint, pixel_ray, with_iterations},
    statistics,
};

/// Step limit of a ray.
const STEPS: u32 = 400;
/// More iterations than any view here needs.
const AMPLE_ITERATIONS: u32 = 100;
/// Fraction of the pixels that may change between hit and miss.
const MAX_HIT_CHANGES: f64 = 0.002;
/// Fraction of the depths that must move by less than a footprint.
const DEPTH_QUANTILE: f64 = 0.99;
/// About how many pixels are compared.
const PIXELS: u32 = 4000;

/// The march of `literal.wgsl`, in f64.
fn march(estimator: &Estimator, ray: Ray, bailout: f64, epsilon: f64) -> Option<f64> {
    let mut t = 0.0;
    for _ in 0..STEPS {
        let point: DVec3 = ray.at(t);
        if point.length() > bailout && point.dot(ray.direction) > 0.0 {
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

/// Finds the tuning for a scene at a size.
pub fn find(scene: &Scene, size_px: [u32; 2]) -> Tuning {
    let pixels = evenly_spaced(size_px, PIXELS);
    let cone = footprint(scene, size_px);
    let ample = with_iterations(&Mandelbulb::of(&scene.fractal), AMPLE_ITERATIONS);
    let depths = statistics::in_parallel(&pixels, |&pixel| {
        ample.march(pixel_ray(scene, size_px, pixel), cone, f64::INFINITY)
    });
    let epsilon = cone * statistics::quantile(depths.into_iter().flatten().collect(), 0.5);
    let depths_with = |iterations: u32| {
        let estimator = with_iterations(&Mandelbulb::of(&scene.fractal), iterations);
        statistics::in_parallel(&pixels, |&pixel| {
            march(&estimator, pixel_ray(scene, size_px, pixel), scene.fractal.bailout, epsilon)
        })
    };
    let expected = depths_with(AMPLE_ITERATIONS);
    let suffices = |iterations: &u32| {
        let both: Vec<_> = depths_with(*iterations).into_iter().zip(&expected).collect();
        let differ = both.iter().filter(|(a, b)| a.is_some() != b.is_some()).count();
        let moved: Vec<_> = both.iter().filter_map(|(a, b)| Some(((*a)? - (**b)?).abs())).collect();
        differ as f64 <= MAX_HIT_CHANGES * both.len() as f64
            && statistics::quantile(moved, DEPTH_QUANTILE) < epsilon
    };
    let iterations = (2..AMPLE_ITERATIONS).find(suffices).unwrap_or(AMPLE_ITERATIONS);
    Tuning { epsilon, iterations, steps: STEPS }
}
