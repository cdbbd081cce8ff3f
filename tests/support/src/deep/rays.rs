//! Rays of a camera at any depth, marched in short steps.
//!
//! What counts as a hit is the document's: nearer than the pixel's cone is wide, times the detail
//! setting; at powers below 4 for half of that length along the ray, in views about an anchor at half of the points there.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::{DVec2, DVec3};
use mandelight::{
    formula::mandelbulb::Mandelbulb,
    fractal::FractalModel,
    render::{Region, space::wants_anchor},
    scene::{Camera, Fractal, Precise, Scene},
};

use super::{
    arithmetic::{Number, Point, Real, moved, rounded},
    orbit::{Estimate, Set},
};

/// Longest step, scene units: a Julia orbit close to the origin makes estimates of any size.
const LONGEST_STEP: f64 = 0.05;
/// Part of the hit distance that a step covers at least.
const MIN_STEP: f64 = 0.1;
/// A sphere that holds every set: from |z| ≥ 2.5 and |c| ≤ 2√3, |z|² − |c| > |z|.
const HOLDS_ALL: f64 = 2.5;
/// What is farther away than so many view units counts as background.
pub const FARTHEST: f64 = 1000.0;
/// A ray that is still on its way after so many steps is as near as it will get.
const MAX_STEPS: u32 = 20_000;
/// At powers below 4, where a ray must be near for a hit: shares of the hit distance past the entry.
const STILL: [f64; 6] = [0.5 / 6.0, 1.0 / 6.0, 0.25, 2.0 / 6.0, 2.5 / 6.0, 0.5];

/// The least hit distance at the pivot of views whose orbits f64 follows, scene units: seven of its digits are left there.
const LEAST_OF_F64: f64 = 1e-9;

/// A picture's width and height in pixels.
pub type Size = [u32; 2];

/// Where a march ends.
pub enum Way<T> {
    /// At an answer.
    Answered(T),
    /// Past everything that counts.
    Past,
    /// On its way still, at this depth, after all its steps.
    Creeping(f64),
}

/// A set and the camera that looks at it, by orbits of numbers `N`.
pub struct SetView<'a, N = Real> {
    pub set: Set<N>,
    pub size: Size,
    scene: &'a Scene,
    eye: Point<N>,
    unit: f64,
    /// How many of the points of [`STILL`] must be near.
    near_points: usize,
    orbit_steps: AtomicU64,
}

impl<'a> SetView<'a, f64> {
    /// Looks at `scene` by orbits of f64; none where these are too coarse.
    pub fn in_f64(scene: &'a Scene, size: Size, iterations: u32) -> Option<Self> {
        let looking = Self::new(scene, size, iterations);
        (looking.hit_distance(looking.unit) >= LEAST_OF_F64).then_some(looking)
    }
}

impl<'a> SetView<'a, Real> {
    /// Looks at `scene` by orbits of 192 bits.
    pub fn exact(scene: &'a Scene, size: Size, iterations: u32) -> Self {
        Self::new(scene, size, iterations)
    }

    /// The normal at `depth` of a pixel's ray: of the point, or of the pixel's footprint where the estimate ripples below
    /// a pixel; turned to the eye.
    pub fn normal(&self, pixel: [u32; 2], depth: f64) -> DVec3 {
        let direction = self.direction(centre(pixel));
        let gradient =
            self.set.gradient(&self.at(direction, depth), 1e-6 * self.hit_distance(depth));
        if gradient != DVec3::ZERO && gradient.dot(direction) <= 0.0 {
            return gradient.normalize();
        }
        self.footprint_normal(direction, depth, 2)
    }
}

impl<'a, N: Number> SetView<'a, N> {
    /// Looks at `scene` with orbits of up to `iterations` steps.
    fn new(scene: &'a Scene, size: Size, iterations: u32) -> Self {
        let position = &scene.camera.position.0;
        let model = FractalModel::new(&scene.fractal);
        let has_anchor = wants_anchor(&model, scene, Region::whole(size));
        Self {
            set: Set::new(&Mandelbulb::of(&scene.fractal), iterations),
            size,
            scene,
            eye: position.each_ref().map(|v: &Precise| N::parse(&v.to_string())),
            unit: scene.camera.view_unit(),
            near_points: if has_anchor { STILL.len() / 2 } else { STILL.len() },
            orbit_steps: AtomicU64::new(0),
        }
    }

    /// The unit direction through a point of the picture, in pixels from its upper left corner.
    pub fn direction(&self, [x, y]: [f64; 2]) -> DVec3 {
        let camera = &self.scene.camera;
        let [width, height] = self.size.map(f64::from);
        let ndc = DVec2::new(x / width * 2.0 - 1.0, 1.0 - y / height * 2.0);
        let half_height = half_height(camera);
        let seen = DVec3::new(ndc.x * half_height * width / height, ndc.y * half_height, -1.0);
        (camera.rotation() * seen).normalize()
    }

    /// Radius of a pixel's cone at `depth`.
    pub fn footprint(&self, depth: f64) -> f64 {
        half_height(&self.scene.camera) / f64::from(self.size[1]) * depth
    }

    /// How near counts as a hit at `depth`.
    pub fn hit_distance(&self, depth: f64) -> f64 {
        self.scene.quality.detail * self.footprint(depth)
    }

    /// The point at `depth` along a direction.
    pub fn at(&self, direction: DVec3, depth: f64) -> Point<N> {
        moved(&self.eye, direction * depth)
    }

    /// The set's description.
    pub fn fractal(&self) -> &Fractal {
        &self.scene.fractal
    }

    /// A picture's depth as a hit; none for a miss, and beyond what counts as background.
    pub fn hit_at(&self, depth: f32) -> Option<f64> {
        let depth = f64::from(depth);
        (depth > 0.0 && depth < FARTHEST * self.unit).then_some(depth)
    }

    /// Marches a ray until `look` at a depth and its estimate answers; `step` makes steps of estimates.
    pub fn look_along<T>(
        &self,
        direction: DVec3,
        step: impl Fn(Estimate) -> f64,
        look: impl FnMut(f64, Estimate) -> Option<T>,
    ) -> Way<T> {
        let Some((near, far)) = crossing(rounded(&self.eye), direction) else { return Way::Past };
        let range = [near.max(0.0), far.min(FARTHEST * self.unit)];
        let step = |depth, estimate| {
            step(estimate).clamp(MIN_STEP * self.hit_distance(depth), LONGEST_STEP)
        };
        self.look_between(direction, range, step, look)
    }

    /// The same between two depths, by steps of any length.
    pub fn look_between<T>(
        &self,
        direction: DVec3,
        [near, far]: [f64; 2],
        step: impl Fn(f64, Estimate) -> f64,
        mut look: impl FnMut(f64, Estimate) -> Option<T>,
    ) -> Way<T> {
        let mut t = near;
        for _ in 0..MAX_STEPS {
            if t > far {
                return Way::Past;
            }
            let here = self.estimate(direction, t);
            if let Some(answer) = look(t, here) {
                return Way::Answered(answer);
            }
            t += step(t, here);
        }
        Way::Creeping(t)
    }

    /// The estimate at a depth along a direction.
    pub fn estimate(&self, direction: DVec3, depth: f64) -> Estimate {
        let grain = MIN_STEP * self.hit_distance(depth);
        let estimate = self.set.estimate(&self.at(direction, depth), grain);
        self.orbit_steps.fetch_add(estimate.steps.into(), Ordering::Relaxed);
        estimate
    }

    /// Orbit steps of all estimates so far.
    pub fn orbit_steps(&self) -> u64 {
        self.orbit_steps.load(Ordering::Relaxed)
    }

    /// Depth of the surface along a ray whose steps `step` makes of estimates.
    pub fn march(&self, direction: DVec3, step: impl Fn(Estimate) -> f64) -> Option<f64> {
        let is_near = |t: f64| self.estimate(direction, t).distance < self.hit_distance(t);
        let mut last = None;
        let way = self.look_along(direction, step, |t, here| {
            let hit = self.hit_distance(t);
            let is_here = here.distance < hit;
            let (before, was_near) = last.replace((t, is_here)).unwrap_or((t, false));
            if !is_here || was_near {
                return None;
            }
            if Mandelbulb::of(&self.scene.fractal).power >= 4.0 {
                return Some(t);
            }
            let entry = entry(before, t, is_near);
            let near = STILL.iter().filter(|share| is_near(entry + *share * hit)).count();
            (near >= self.near_points).then_some(entry)
        });
        match way {
            Way::Answered(depth) | Way::Creeping(depth) => Some(depth),
            Way::Past => None,
        }
    }

    /// Depth at the centre of a pixel, counted from the upper left.
    pub fn depth(&self, pixel: [u32; 2]) -> Option<f64> {
        self.march(self.direction(centre(pixel)), |estimate| estimate.step)
    }

    /// The normal of a pixel's footprint: the slope of the linear function that fits a grid in a cube best, turned to the
    /// eye. The cube is two hit distances wide, one in front of the depth, and cut into `cuts`³ cells, whose corners count.
    pub fn footprint_normal(&self, direction: DVec3, depth: f64, cuts: u32) -> DVec3 {
        let hit = self.hit_distance(depth);
        let center = self.at(direction, depth - hit);
        let steps = || (0..=cuts).map(move |k| 2.0 * f64::from(k) / f64::from(cuts) - 1.0);
        let grid = steps().flat_map(|x| steps().map(move |y| (x, y)));
        let grid = grid.flat_map(|(x, y)| steps().map(move |z| DVec3::new(x, y, z)));
        let slope = |offset: DVec3| {
            offset * self.set.estimate(&moved(&center, offset * hit), 1e-3 * hit).distance
        };
        let normal = grid.map(slope).sum::<DVec3>().normalize_or(-direction);
        let away = normal.dot(direction).max(0.0);
        (normal - away * direction).normalize_or(-direction)
    }
}

/// A picture's pixels with their indices, row by row from the top.
pub fn pixels([width, height]: Size) -> impl Iterator<Item = ([u32; 2], usize)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y])).zip(0..)
}

/// Where a pixel's centre is.
pub fn centre(pixel: [u32; 2]) -> [f64; 2] {
    pixel.map(|v| f64::from(v) + 0.5)
}

fn half_height(camera: &Camera) -> f64 {
    (camera.vertical_fov_deg.to_radians() / 2.0).tan()
}

/// Where a line crosses the sphere of [`HOLDS_ALL`].
fn crossing(origin: DVec3, direction: DVec3) -> Option<(f64, f64)> {
    let b = origin.dot(direction);
    let under_root = b * b - origin.length_squared() + HOLDS_ALL * HOLDS_ALL;
    (under_root > 0.0).then(|| (-b - under_root.sqrt(), -b + under_root.sqrt()))
}

/// Where a ray comes near, between a place where it is not and one where it is.
fn entry(mut away: f64, mut near: f64, is_near: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..12 {
        let middle = 0.5 * (away + near);
        *(if is_near(middle) { &mut near } else { &mut away }) = middle;
    }
    near
}
