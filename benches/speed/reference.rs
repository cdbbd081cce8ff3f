//! What a picture should show, in f64: hits, depths, normals, shadows.
//!
//! A pixel shows where its ray first comes within the pixel's footprint of the set: what is finer
//! no pixel can show; and what it is near to for less than half a footprint along the ray is
//! passed. The reference finds that place by short steps and halving, to a
//! thousandth of a footprint, with more iterations than anything here needs. The surface has the
//! estimate's own gradient there as normal. A light reaches it where no way back from outside of
//! the set to a place two footprints above the surface comes within [`BLOCKS`] footprints of the
//! set.

use glam::DVec3;
use mandelight::{
    fractal::{Estimator, Ray},
    scene::Scene,
};

use super::pixels::{footprint, pixel_ray, with_iterations};

/// More iterations than any view needs: `errors` would show it.
const ITERATIONS: u32 = 100;
/// The part of the careful step that the reference takes.
const STEP_PART: f64 = 0.25;
/// Least step of a camera ray, footprints.
const LEAST_STEP: f64 = 0.02;
/// How near the set counts as in the light's way, footprints.
const BLOCKS: f64 = 0.1;
/// Where a ray has to be still as near, behind the place where it came near, footprints: at power 2 an
/// estimate dips for thousandths of a footprint, and which of the dips short steps meet is chance.
const STILL: [f64; 6] = [0.5 / 6.0, 1.0 / 6.0, 0.25, 2.0 / 6.0, 2.5 / 6.0, 0.5];
/// Rays that are still on their way then have all but arrived.
const MOST_STEPS: u32 = 100_000;

/// What one pixel should show.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    /// Depth along the ray, scene units.
    pub depth: f64,
    /// The pixel's footprint there, scene units.
    pub footprint: f64,
    /// The unit normal.
    pub normal: DVec3,
    /// A bit a light that reaches the point.
    pub visibility: u64,
}

/// The reference of one scene in one size.
pub struct Reference {
    scene: Scene,
    size_px: [u32; 2],
    estimator: Estimator,
    cone: f64,
    lights: Vec<DVec3>,
}

impl Reference {
    /// Prepares it; `lights` are unit vectors toward the scene's lights.
    pub fn new(scene: &Scene, size_px: [u32; 2]) -> Self {
        let lights =
            scene.lights.environment.iter().map(|light| DVec3::from_array(light.direction));
        Self {
            scene: scene.clone(),
            size_px,
            estimator: with_iterations(&scene.fractal, ITERATIONS),
            cone: footprint(scene, size_px),
            lights: lights.collect(),
        }
    }

    /// What a pixel should show; none where its ray meets nothing.
    pub fn look(&self, pixel: [u32; 2]) -> Option<Truth> {
        let ray = pixel_ray(&self.scene, self.size_px, pixel);
        let depth = self.march(ray)?;
        let (point, footprint) = (ray.at(depth), self.cone * depth);
        let normal = self.normal(point, footprint);
        let visibility = self.visibility(point, normal, footprint);
        Some(Truth { depth, footprint, normal, visibility })
    }

    /// A bit for each light that reaches a point of the surface.
    pub fn visibility(&self, point: DVec3, normal: DVec3, footprint: f64) -> u64 {
        let reaches =
            |light: DVec3| normal.dot(light) > 0.0 && self.is_lit(point, normal, footprint, light);
        (0..).zip(&self.lights).map(|(k, light)| u64::from(reaches(*light)) << k).sum()
    }

    fn march(&self, ray: Ray) -> Option<f64> {
        let (near, far) = ray.sphere_span(DVec3::ZERO, self.estimator.bounding_radius())?;
        let (mut before, mut depth, mut was_near) = (near, near, false);
        for _ in 0..MOST_STEPS {
            if depth > far {
                return None;
            }
            let (estimate, hit) = (self.estimator.estimate(ray.at(depth)), self.cone * depth);
            let is_near = estimate.distance < hit;
            if is_near && !was_near {
                let entry = self.halve(ray, before, depth);
                let lasts = |part: &f64| self.estimator.distance(ray.at(entry + part * hit)) < hit;
                if STILL.iter().all(lasts) {
                    return Some(entry);
                }
            }
            (before, was_near) = (depth, is_near);
            depth += (STEP_PART * estimate.step).max(LEAST_STEP * hit);
        }
        Some(depth)
    }

    /// Where between two depths the ray comes within a footprint.
    fn halve(&self, ray: Ray, mut outside: f64, mut inside: f64) -> f64 {
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

    /// The estimate's gradient, by differences so short that the estimate is straight between them.
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
        for _ in 0..MOST_STEPS {
            if s <= footprint {
                return true;
            }
            let estimate = self.estimator.estimate(ray.at(s));
            let is_near = |s: f64| self.estimator.distance(ray.at(s)) < BLOCKS * footprint;
            if estimate.distance < BLOCKS * footprint
                && STILL.iter().all(|part| is_near(s - part * footprint))
            {
                return false;
            }
            s -= (STEP_PART * estimate.step).max(LEAST_STEP * footprint);
        }
        true
    }
}
