//! The reference in f64: hits, depths, normals and shadows.
//!
//! In: a scene and a picture's size. Out: a [`ReferencePixel`] per pixel. A hit is where a ray
//! first comes within the pixel's footprint of the set and stays there for half a footprint;
//! finer details are below a pixel's size. The reference takes short steps and bisects to a
//! thousandth of a footprint. The normal is the gradient of the distance estimate. A light
//! reaches a hit if the ray from outside of the set to a point two footprints above the surface
//! stays at least [`OCCLUDER_DISTANCE`] footprints away from the set.

use glam::DVec3;
use mandelight::{
    formula::{
        Ray,
        mandelbulb::{Mandelbulb, estimator::Estimator},
    },
    scene::Scene,
};

use super::pixels::{footprint, pixel_ray, with_iterations};

/// More iterations than any view needs.
const ITERATIONS: u32 = 100;
/// Factor on the estimator's conservative step.
const STEP_FACTOR: f64 = 0.25;
/// Least step, footprints.
const MIN_STEP: f64 = 0.02;
/// Distance at which the set blocks a shadow ray, footprints.
const OCCLUDER_DISTANCE: f64 = 0.1;
/// Distances behind a first hit at which the ray must still be as near, footprints.
///
/// At power 2 the estimate has false minima of thousandths of a footprint, and the step length
/// decides by chance which of them a ray samples.
const CONFIRMED_AT: [f64; 6] = [0.5 / 6.0, 1.0 / 6.0, 0.25, 2.0 / 6.0, 2.5 / 6.0, 0.5];
/// Step limit of a ray, which then counts as a hit, or as lit.
const MAX_STEPS: u32 = 100_000;

/// The reference of one pixel.
#[derive(Clone, Copy, Debug)]
pub struct ReferencePixel {
    /// Depth along the ray, scene units.
    pub depth: f64,
    /// The pixel's footprint at that depth, scene units.
    pub footprint: f64,
    /// The unit normal.
    pub normal: DVec3,
    /// Bit k is set if light k reaches the point.
    pub visibility: u64,
}

/// The reference of one scene at one size.
pub struct Reference {
    scene: Scene,
    size_px: [u32; 2],
    estimator: Estimator,
    cone: f64,
    lights: Vec<DVec3>,
}

impl Reference {
    /// Prepares the estimator and the lights' directions.
    pub fn new(scene: &Scene, size_px: [u32; 2]) -> Self {
        let lights =
            scene.lights.environment.iter().map(|light| DVec3::from_array(light.direction));
        Self {
            scene: scene.clone(),
            size_px,
            estimator: with_iterations(&Mandelbulb::of(&scene.fractal), ITERATIONS),
            cone: footprint(scene, size_px),
            lights: lights.collect(),
        }
    }

    /// The reference of a pixel; none for a miss.
    pub fn pixel(&self, pixel: [u32; 2]) -> Option<ReferencePixel> {
        let ray = pixel_ray(&self.scene, self.size_px, pixel);
        let depth = self.march(ray)?;
        let (point, footprint) = (ray.at(depth), self.cone * depth);
        let normal = self.normal(point, footprint);
        let visibility = self.visibility(point, normal, footprint);
        Some(ReferencePixel { depth, footprint, normal, visibility })
    }

    /// Visibility of a point of the surface: bit k is set if light k reaches it.
    pub fn visibility(&self, point: DVec3, normal: DVec3, footprint: f64) -> u64 {
        let reaches =
            |light: DVec3| normal.dot(light) > 0.0 && self.is_lit(point, normal, footprint, light);
        (0..).zip(&self.lights).map(|(k, light)| u64::from(reaches(*light)) << k).sum()
    }

    fn march(&self, ray: Ray) -> Option<f64> {
        let (near, far) = ray.sphere_span(DVec3::ZERO, self.estimator.bounding_radius())?;
        let (mut before, mut depth, mut was_near) = (near, near, false);
        for _ in 0..MAX_STEPS {
            if depth > far {
                return None;
            }
            let (estimate, hit) = (self.estimator.estimate(ray.at(depth)), self.cone * depth);
            let is_near = estimate.distance < hit;
            if is_near && !was_near {
                let entry = self.bisect(ray, before, depth);
                let lasts = |part: &f64| self.estimator.distance(ray.at(entry + part * hit)) < hit;
                if CONFIRMED_AT.iter().all(lasts) {
                    return Some(entry);
                }
            }
            (before, was_near) = (depth, is_near);
            depth += (STEP_FACTOR * estimate.step).max(MIN_STEP * hit);
        }
        Some(depth)
    }

    /// The depth between `outside` and `inside` at which the ray comes within a footprint.
    fn bisect(&self, ray: Ray, mut outside: f64, mut inside: f64) -> f64 {
        while inside - outside > 1e-3 * self.cone * inside {
            let middle = 0.5 * (outside + inside);
            if self.estimator.distance(ray.at(middle)) < self.cone * middle {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        inside
    }

    /// The estimate's gradient by central differences, short enough that the estimate is linear.
    pub fn normal(&self, point: DVec3, footprint: f64) -> DVec3 {
        let h = 1e-4 * footprint;
        let along = |axis: DVec3| {
            self.estimator.distance(point + axis * h) - self.estimator.distance(point - axis * h)
        };
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize_or_zero()
    }

    fn is_lit(&self, point: DVec3, normal: DVec3, footprint: f64, light: DVec3) -> bool {
        let ray = Ray { origin: point + normal * (2.0 * footprint), direction: light };
        let Some((_, far)) = ray.sphere_span(DVec3::ZERO, self.estimator.bounding_radius()) else {
            return true;
        };
        let mut s = far;
        for _ in 0..MAX_STEPS {
            if s <= footprint {
                return true;
            }
            let estimate = self.estimator.estimate(ray.at(s));
            let is_near =
                |s: f64| self.estimator.distance(ray.at(s)) < OCCLUDER_DISTANCE * footprint;
            if estimate.distance < OCCLUDER_DISTANCE * footprint
                && CONFIRMED_AT.iter().all(|part| is_near(s - part * footprint))
            {
                return false;
            }
            s -= (STEP_FACTOR * estimate.step).max(MIN_STEP * footprint);
        }
        true
    }
}
