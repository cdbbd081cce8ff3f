//! Oracle: rays through pixels, sphere tracing in small steps, normals, shadow rays.

use glam::{DVec2, DVec3};
use mandelight::{
    formula::mandelbulb::Mandelbulb,
    scene::{Camera, Scene},
};

use super::estimate::distance;

/// Part of the estimate that a step covers: small, since the estimate is no true bound.
const STEP_PART: f64 = 0.2;
/// Longest step, scene units: a Julia orbit close to the origin makes estimates of any size.
const LONGEST_STEP: f64 = 0.05;
/// A sphere that holds every set: from |z| ≥ 2.5 and |c| ≤ 2√3, |z|² − |c| > |z|.
const HOLDS_ALL: f64 = 2.5;
/// A ray that is still on its way after so many steps is as near as it will get.
const MAX_STEPS: u32 = 20_000;

/// At powers below 4 a ray passes what it is near to for less than half of the hit distance: shares of
/// that at which it is asked.
const STILL: [f64; 6] = [0.5 / 6.0, 1.0 / 6.0, 0.25, 2.0 / 6.0, 2.5 / 6.0, 0.5];
/// Part of the hit distance that a step covers at least inside of what is passed.
const MIN_STEP: f64 = 0.01;

/// A picture's width and height in pixels.
pub type Size = [u32; 2];

/// The unit direction through the centre of pixel (x, y), counted from the upper left.
pub fn direction(camera: &Camera, size: Size, [x, y]: [u32; 2]) -> DVec3 {
    direction_at(camera, size, [f64::from(x) + 0.5, f64::from(y) + 0.5])
}

/// The unit direction through a place of a picture, in pixels from the upper left corner.
pub fn direction_at(camera: &Camera, size: Size, [x, y]: [f64; 2]) -> DVec3 {
    let [width, height] = size.map(f64::from);
    let ndc = DVec2::new(x / width * 2.0 - 1.0, 1.0 - y / height * 2.0);
    let half_height = (camera.vertical_fov_deg.to_radians() / 2.0).tan();
    let seen = DVec3::new(ndc.x * half_height * width / height, ndc.y * half_height, -1.0);
    (camera.rotation() * seen).normalize()
}

/// Radius of a pixel's cone at depth one.
pub fn cone(camera: &Camera, size: Size) -> f64 {
    (camera.vertical_fov_deg.to_radians() / 2.0).tan() / f64::from(size[1])
}

/// How near counts as a hit at `depth`.
pub fn hit_distance(scene: &Scene, size: Size, depth: f64) -> f64 {
    scene.quality.detail * cone(&scene.camera, size) * depth
}

/// Where a line crosses the sphere of [`HOLDS_ALL`].
fn crossing(origin: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let b = origin.dot(direction);
    let under_root = b * b - origin.length_squared() + HOLDS_ALL * HOLDS_ALL;
    (under_root > 0.0).then(|| (-b - under_root.sqrt(), -b + under_root.sqrt()))
}

/// Depth of the surface along the ray of a pixel.
pub fn march(scene: &Scene, size: Size, pixel: [u32; 2]) -> Option<f64> {
    let origin = scene.camera.position.to_dvec3();
    let direction = direction(&scene.camera, size, pixel);
    let (near, far) = crossing(origin, direction)?;
    let is_near = |t: f64| {
        distance(&Mandelbulb::of(&scene.fractal), origin + direction * t)
            < hit_distance(scene, size, t)
    };
    let mut t = near.max(0.0);
    let (mut before, mut was_near) = (t, false);
    for _ in 0..MAX_STEPS {
        if t > far {
            return None;
        }
        let d = distance(&Mandelbulb::of(&scene.fractal), origin + direction * t);
        let hit = hit_distance(scene, size, t);
        if d < hit && !was_near {
            if Mandelbulb::of(&scene.fractal).power >= 4.0 {
                return Some(t);
            }
            let entry = entry(before, t, is_near);
            if STILL.iter().all(|share| is_near(entry + share * hit)) {
                return Some(entry);
            }
        }
        (before, was_near) = (t, d < hit);
        t += (STEP_PART * d).clamp(MIN_STEP * hit, LONGEST_STEP);
    }
    Some(t)
}

/// Depth of the point whose orbit gives the colours, on the ray of a pixel that hits at `depth`.
///
/// There the ray came within 1/300 of what the picture's height shows; it has not been eight times as far
/// from the surface since.
pub fn color_depth(scene: &Scene, size: Size, pixel: [u32; 2], depth: f64) -> f64 {
    let origin = scene.camera.position.to_dvec3();
    let direction = direction(&scene.camera, size, pixel);
    let height = 2.0 * cone(&scene.camera, size) * f64::from(size[1]);
    let ahead = direction.dot(scene.camera.forward());
    let (near, _) = crossing(origin, direction).expect("a ray that hits");
    let mut t = near.max(0.0);
    let mut found = None;
    while t < depth {
        let within = height * ahead * t / 300.0;
        let d = distance(&Mandelbulb::of(&scene.fractal), origin + direction * t);
        if d > 8.0 * within {
            found = None;
        } else if d < within && found.is_none() {
            found = Some(t);
        }
        t += (0.05 * d).clamp(1e-3 * within, LONGEST_STEP);
    }
    found.unwrap_or(depth)
}

/// Where a ray comes near, between a place where it is not and one where it is.
fn entry(mut away: f64, mut near: f64, is_near: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..12 {
        let middle = 0.5 * (away + near);
        *(if is_near(middle) { &mut near } else { &mut away }) = middle;
    }
    near
}

/// The normal from six samples on the main axes of a grid (thesis figure 3.3 c).
pub fn normal(fractal: &Mandelbulb, p: DVec3, spacing: f64) -> DVec3 {
    let along =
        |axis: DVec3| distance(fractal, p + axis * spacing) - distance(fractal, p - axis * spacing);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize_or_zero()
}

/// A light for one point: where it is, and how far away a blocker may be.
pub struct ShadowRay {
    /// Unit vector from the point to the light.
    pub toward: DVec3,
    /// Greatest distance of a blocker from the point.
    pub reach: f64,
}

/// How wide a blocker must be to count: its distance from the ray over that to the point.
pub const SHADOW_CONE: f64 = 0.004;

/// How near the surface comes to the light's ray, over how near counts as blocking: below 1 the
/// light is blocked. At powers below 4 it has to come nearer, and to stay so for half of the hit
/// distance. The ray runs from outside toward the point (thesis 4.5) and ends one hit
/// distance before it; half of that is the least that blocks. The point is lifted off the surface
/// by two hit distances.
pub fn openness(
    fractal: &Mandelbulb,
    point: DVec3,
    normal: DVec3,
    hit: f64,
    ray: &ShadowRay,
) -> f64 {
    let origin = point + normal * (2.0 * hit);
    let Some((_, far)) = crossing(origin, ray.toward) else { return f64::INFINITY };
    let mut s = far.min(ray.reach);
    let mut least = f64::INFINITY;
    let low = (4.0 - fractal.power).clamp(0.0, 1.0);
    let blocks = |s: f64| (SHADOW_CONE * (1.0 - 0.5 * low) * s).max((0.5 - 0.35 * low) * hit);
    let openness = |s: f64| distance(fractal, origin + ray.toward * s) / blocks(s);
    while s > hit {
        let mut open = openness(s);
        let d = open * blocks(s);
        if open < 1.0 && low > 0.0 {
            open = STILL.iter().map(|share| openness(s - share * hit)).fold(open, f64::max);
        }
        least = least.min(open);
        if least < 0.5 {
            break;
        }
        s -= (STEP_PART * d).clamp(MIN_STEP * hit, LONGEST_STEP);
    }
    least
}
