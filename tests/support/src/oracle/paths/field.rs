//! Rays that meet a distance field: sphere tracing (J. Hart, 1996), normals, shadow rays.

use glam::{DVec2, DVec3};
use mandelight::{
    formula::march::MarchPolicy,
    scene::{Normals, Scene},
};

/// Least hit distance.
const FINEST_HIT: f64 = 4e-7;

/// Width of the cones of bounced rays and of their shadow rays, over that of direct light's shadow rays.
pub const PATH_CONE: f32 = 0.125;

/// Rays shorter than so many hit distances of their start lie in a gap.
pub const GAP: f64 = 4.0;
/// Least step, over the hit distance.
const MIN_STEP: f64 = 0.25;
/// Most steps of a ray.
const MAX_STEPS: u32 = 4000;
/// Spacing of the differences that stand for a gradient.
const FINE: f64 = 1e-6;

/// A distance estimate at a point.
pub type Distance = Box<dyn Fn(DVec3) -> f64>;

/// A ray with its cone.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
    /// Least hit distance.
    pub radius: f64,
    /// Hit distance per unit of depth, where that is more.
    pub spread: f64,
    /// Depth up to which it is clear.
    pub clear: f64,
}

/// Where a ray meets the surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The place.
    pub point: DVec3,
    /// Distance from the ray's origin.
    pub depth: f64,
    /// The hit distance there.
    pub radius: f64,
}

/// A surface.
pub struct Field {
    /// Estimated distance to the surface.
    pub distance: Distance,
    /// Radius of a sphere about the origin that holds the surface.
    pub bounding_radius: f64,
    /// How rays step.
    pub policy: MarchPolicy,
    /// Whether normals are those of six samples; else the gradient.
    six_samples: bool,
}

impl Field {
    /// The surface of a scene, with its estimate.
    pub fn new(scene: &Scene, distance: Distance) -> Self {
        let formula = scene.fractal.formula();
        let policy = formula.march_policy(&scene.fractal);
        assert!(!policy.checks_hits, "hits that must last have no oracle here");
        let six_samples = match scene.quality.normals {
            Normals::Six => true,
            Normals::Analytic => false,
            other => panic!("no oracle of {other:?}"),
        };
        let bounding_radius = formula.distance_field(&scene.fractal).bounding_radius();
        Self { distance, bounding_radius, policy, six_samples }
    }

    /// Depths between which a line is in the bounding sphere.
    fn inside(&self, origin: DVec3, direction: DVec3) -> Option<[f64; 2]> {
        let middle = -origin.dot(direction);
        let closest = origin + middle * direction;
        let under_root = self.bounding_radius.powi(2) - closest.length_squared();
        (under_root > 0.0).then(|| [middle - under_root.sqrt(), middle + under_root.sqrt()])
    }

    /// Where a ray meets the surface within a length: the hit distance's crossing, interpolated on the last step.
    pub fn meet(&self, ray: &Ray, longest: f64) -> Option<Hit> {
        let [entry, exit] = self.inside(ray.origin, ray.direction)?;
        let end = exit.min(longest);
        let hit_distance = |t: f64| ray.radius.max(ray.spread * t).max(FINEST_HIT);
        let at = |t: f64| ray.origin + t * ray.direction;
        let hit = |depth: f64| Some(Hit { point: at(depth), depth, radius: hit_distance(depth) });
        let mut t = entry.max(0.0).max(ray.clear);
        // The last point of the way, and what was left to a hit there.
        let (mut before, mut left) = (t, 0.0);
        let mut steps = Steps::new(&self.policy);
        for _ in 0..MAX_STEPS {
            let distance = if t > end { 0.0 } else { (self.distance)(at(t)) };
            let ball = f64::from(self.policy.ball_part) * distance;
            if let Some(back) = steps.back(ball) {
                t -= back;
                continue;
            }
            if t > end {
                return None;
            }
            let missing = distance - hit_distance(t);
            if missing < 0.0 {
                return hit(before + (t - before) * left / (left - missing));
            }
            (before, left) = (t, missing);
            t += steps.next(ball.max(MIN_STEP * hit_distance(t)));
        }
        hit(t)
    }

    /// The normal at a hit, as a G-buffer stores it; toward the viewer where the field is flat.
    pub fn normal(&self, hit: &Hit, viewer: DVec3) -> DVec3 {
        let spacing = if self.six_samples { hit.radius } else { FINE };
        let along = |axis: DVec3| {
            (self.distance)(hit.point + spacing * axis)
                - (self.distance)(hit.point - spacing * axis)
        };
        let gradient = DVec3::from(DVec3::AXES.map(along));
        stored(gradient.try_normalize().unwrap_or(viewer))
    }

    /// Whether nothing up to a distance blocks the light that comes to a point from a direction.
    ///
    /// The ray runs inward (thesis 4.5); `hit` is the point's hit distance, within which nothing counts.
    pub fn is_open(&self, point: DVec3, hit: f64, direction: DVec3, farthest: f64) -> bool {
        let Some([_, exit]) = self.inside(point, direction) else { return true };
        let [cone, margin, min_step, part] = [
            PATH_CONE * self.policy.shadow_cone,
            self.policy.shadow_margin,
            self.policy.shadow_min_step,
            self.policy.ball_part,
        ]
        .map(f64::from);
        let mut s = farthest.min(exit);
        let mut steps = Steps::new(&self.policy);
        for _ in 0..MAX_STEPS {
            let distance = if s > hit { (self.distance)(point + s * direction) } else { 0.0 };
            let ball = part * distance;
            let back = steps.back(ball);
            s += back.unwrap_or(0.0);
            if s <= hit {
                return true;
            }
            if back.is_some() {
                continue;
            }
            let blocks = (cone * s).max(margin * hit);
            if distance < blocks {
                return false;
            }
            s -= steps.next(ball.max(MIN_STEP * blocks).max(min_step * hit));
        }
        true
    }
}

/// Steps longer than the empty ball, taken back where the next ball leaves a gap (B. Keinert et al., Enhanced Sphere
/// Tracing, STAG 2014). Longer steps end more rays in front of a curved estimate, so they are the kernels' own.
struct Steps {
    /// Step over ball.
    relaxation: f64,
    /// The same for the next step.
    next: f64,
    /// What the last step went past its ball.
    past: f64,
}

impl Steps {
    fn new(policy: &MarchPolicy) -> Self {
        let relaxation = f64::from(policy.relaxation);
        Self { relaxation, next: relaxation, past: 0.0 }
    }

    /// The way back, if a ball here does not touch the last one.
    fn back(&mut self, ball: f64) -> Option<f64> {
        let past = self.past;
        (past > ball).then(|| {
            (self.next, self.past) = (1.0, 0.0);
            past
        })
    }

    fn next(&mut self, ball: f64) -> f64 {
        let step = self.next * ball;
        (self.next, self.past) = (self.relaxation, step - ball);
        step
    }
}

/// A unit vector after it was stored in 32 bits on an octahedron (Z. Cigolle et al., JCGT 3(2), 2014).
fn stored(n: DVec3) -> DVec3 {
    let round = |x: f64| (x.clamp(-1.0, 1.0) * 32767.0).round() / 32767.0;
    let sign = |v: DVec2| v.map(|x| if x < 0.0 { -1.0 } else { 1.0 });
    let fold = |v: DVec2| (1.0 - DVec2::new(v.y, v.x).abs()) * sign(v);
    let flat = DVec2::new(n.x, n.y) / (n.x.abs() + n.y.abs() + n.z.abs());
    let flat = (if n.z < 0.0 { fold(flat) } else { flat }).map(round);
    let z = 1.0 - flat.x.abs() - flat.y.abs();
    (if z < 0.0 { fold(flat) } else { flat }).extend(z).normalize()
}
