//! Pixels to compare, and their rays, cones and estimators in f64.
//!
//! In: a scene and a picture's size. Out: what the tuning and the reference both march.

use glam::DVec2;
use mandelight::{
    formula::{
        Ray,
        mandelbulb::{Mandelbulb, estimator::Estimator},
    },
    fractal::{camera_ray, pixel_cone},
    scene::{PrecisePoint, Scene},
};

/// About `count` pixels, evenly spaced over a picture.
pub fn evenly_spaced(size_px: [u32; 2], count: u32) -> Vec<[u32; 2]> {
    let [width, height] = size_px;
    let every = (f64::from(width) * f64::from(height) / f64::from(count)).sqrt().max(1.0);
    let along = |side: u32| {
        let places = (f64::from(side) / every).max(1.0) as u32;
        move |i: u32| ((f64::from(i) + 0.5) * f64::from(side) / f64::from(places)) as u32
    };
    let (columns, rows) = ((f64::from(width) / every) as u32, (f64::from(height) / every) as u32);
    let (x, y) = (along(width), along(height));
    (0..rows.max(1))
        .flat_map(|j| (0..columns.max(1)).map(move |i| [i, j]))
        .map(|[i, j]| [x(i), y(j)])
        .collect()
}

/// The ray through a pixel's centre.
pub fn pixel_ray(scene: &Scene, size_px: [u32; 2], pixel: [u32; 2]) -> Ray {
    let [width, height] = size_px.map(f64::from);
    let [x, y] = pixel.map(|v| f64::from(v) + 0.5);
    let ndc = DVec2::new(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height);
    camera_ray(&scene.camera, &PrecisePoint::ORIGIN, ndc, width / height)
}

/// Radius of a pixel's cone at depth one.
pub fn footprint(scene: &Scene, size_px: [u32; 2]) -> f64 {
    let [width, height] = size_px.map(f64::from);
    pixel_cone(&scene.camera, width / height, height)
}

/// The estimator of a fractal with another iteration limit.
pub fn with_iterations(fractal: &Mandelbulb, iterations: u32) -> Estimator {
    Estimator::new(&Mandelbulb { iterations, ..fractal.clone() })
}
