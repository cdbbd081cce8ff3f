//! Oracle: rays toward the set of any formula, cut by section planes, in steps shorter than the formula's own.

use glam::DVec3;
use mandelight::{
    render::{Region, uniforms::Inputs},
    scene::Scene,
};

use super::{
    orbits::Orbits,
    rays::{self, Size},
};

/// Step over the formula's own step.
const CAUTION: f64 = 0.4;
/// Least step, over the hit distance.
const MIN_STEP: f64 = 0.05;
/// Points along the way that a hit must last.
const LASTING_POINTS: u32 = 12;
/// Most steps of a ray.
const MAX_STEPS: u32 = 6000;

/// The rays of a picture.
pub struct FormulaRays {
    /// The scene with the iterations that its picture has.
    pub scene: Scene,
    /// The orbits of the scene's fractal.
    pub orbits: Orbits,
    size: Size,
    bounding_radius: f64,
    /// Step of a ray over the estimate.
    step: f64,
}

impl FormulaRays {
    /// The rays of a picture of `scene`.
    pub fn new(scene: &Scene, size: Size) -> Self {
        let mut scene = scene.clone();
        scene.fractal.iterations = Inputs::new(&scene, Region::whole(size)).frame.march.iterations;
        let formula = scene.fractal.formula();
        let step = CAUTION * f64::from(formula.march_policy(&scene.fractal).ball_part);
        let bounding_radius = formula.distance_field(&scene.fractal).bounding_radius();
        let orbits = Orbits::of(&scene.fractal);
        Self { scene, orbits, size, bounding_radius, step }
    }

    /// Depth at which the ray of a pixel comes within `hit_factor` of the hit distance; none if it passes the set.
    ///
    /// With a factor below 1, hits of a formula whose hits are checked must last for 0.6 hit distances.
    /// The last depth, if steps run out.
    pub fn march(&self, pixel: [u32; 2], hit_factor: f64) -> Option<f64> {
        let Self { scene, orbits, size, bounding_radius, step } = self;
        let fractal = &scene.fractal;
        let origin = scene.camera.position.to_dvec3();
        let direction = rays::direction(&scene.camera, *size, pixel);
        let hit_distance = |t: f64| hit_factor * rays::hit_distance(scene, *size, t);
        let middle = -origin.dot(direction);
        let half_chord =
            (middle * middle - origin.length_squared() + bounding_radius * bounding_radius).sqrt();
        if half_chord.is_nan() {
            return None;
        }
        let (mut t, mut end) = ((middle - half_chord).max(0.0), middle + half_chord);
        // The way along which a hit must last where hits are checked, in hit distances: longer than the kernels ask.
        let thickness = if hit_factor < 1.0 { 0.6 } else { 0.0 };
        let checks_hits = fractal.formula().march_policy(fractal).checks_hits;
        let lasts = |t: f64| {
            (0..=LASTING_POINTS).all(|i| {
                let part = thickness * f64::from(i) / f64::from(LASTING_POINTS);
                let s = t + part * hit_distance(t) / hit_factor;
                orbits.distance(origin + s * direction) < hit_distance(s)
            })
        };
        let mut band_reach = None;
        for plane in &fractal.section_planes {
            let rise = plane.normal().dot(direction);
            let crossing = (&plane.point - &scene.camera.position).dot(plane.normal()) / rise;
            if rise > 0.0 {
                end = end.min(crossing);
            } else if crossing > t {
                (t, band_reach) = (crossing, Some(plane.band_reach));
            }
        }
        if let Some(band_reach) = band_reach.filter(|_| t <= end) {
            let point = origin + t * direction;
            let is_inside = !orbits.orbit(point).escaped;
            let reach = band_reach.max(hit_distance(t));
            if is_inside || orbits.distance(point) < reach {
                return Some(t);
            }
        }
        for _ in 0..MAX_STEPS {
            if t > end {
                return None;
            }
            let distance = orbits.distance(origin + t * direction);
            if distance < hit_distance(t) && (!checks_hits || lasts(t)) {
                return Some(t);
            }
            t += (step * distance).max(MIN_STEP * hit_distance(t) / hit_factor);
        }
        Some(t)
    }

    /// Where the ray of a pixel is at `depth`.
    pub fn at(&self, pixel: [u32; 2], depth: f64) -> DVec3 {
        let camera = &self.scene.camera;
        camera.position.to_dvec3() + depth * rays::direction(camera, self.size, pixel)
    }
}
