//! Distance fields, sphere tracing and normals, and how rays march on a GPU.
//!
//! A pixel's cone has half the pixel's width as radius. A ray hits where the distance is below the cone's
//! radius times the scene's detail setting; if the estimate has false minima, the distance must stay
//! below for half of that length.
//!
//! Points are vectors in scene units from the field's own origin ([`DistanceField::origin`]). A deep
//! field's origin is near its surface, so f64 resolves the details of a deep picture.

use glam::DVec3;

use super::recurrence::OrbitPosition;
use crate::precise::PrecisePoint;

/// Least radius of a pixel's cone that plain f32 can draw, in scene units.
pub const PLAIN_FOOTPRINT: f64 = 2e-7;

/// Footprint below which views are drawn about an anchor, in scene units.
///
/// The footprint is a pixel's radius at the nearest surface. Coarser views are drawn in plain f32: the limit
/// is twice [`PLAIN_FOOTPRINT`]. Fractals without depth have no anchor.
pub const COARSEST_FOOTPRINT: f64 = 4e-7;

/// Least radius of a pixel's cone in the deepest dive, in scene units.
///
/// With it, the eye of a picture 1000 pixels high at the usual field of view is 1e-27 scene units from
/// the surface.
pub const DEEP_FOOTPRINT: f64 = 4e-31;

/// Most steps of one ray.
///
/// A ray with more creeps along the surface. It counts as a miss here, for picking, and as a hit in
/// `shaders/pass/march.wgsl`.
pub const MAX_MARCH_STEPS: u32 = 4096;

/// Least step of a ray, in hit distances; rays may pass thinner parts of the surface.
pub const MIN_STEP: f64 = 0.25;
/// Least step, in hit distances, if hits are checked ([`DistanceField::needs_hit_check`]).
pub const MIN_STEP_WITH_HIT_CHECK: f64 = 0.4;
/// Length over which a hit is checked, in hit distances.
pub const CHECKED_THICKNESS: f64 = 0.5;
/// Number of points along that length at which a hit is checked.
pub const THICKNESS_CHECKS: u32 = 6;
/// Halvings of the step that crossed the hit distance, to find the crossing.
pub const HALVINGS: u32 = 5;

/// How rays march through a formula's fractals.
///
/// The defaults suit an estimate that is a lower bound of the distance nearly everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchPolicy {
    /// Factor of over-relaxed steps (Keinert et al. 2014), at least 1; 1 takes plain steps.
    pub relaxation: f32,
    /// Radius of the ball that a cone treats as empty, over the safe step.
    ///
    /// [`StepLimits::ball_part`] replaces it for kernels with such limits.
    pub ball_part: f32,
    /// True if the estimate has false minima thinner than a pixel.
    ///
    /// Hits are then checked over half a hit distance.
    pub checks_hits: bool,
    /// True if [`DistanceField::bounding_radius`] is of a sphere that holds the whole set, false if it may cut the set.
    ///
    /// Camera rays beside a sphere that holds the set can be within the hit distance of the set.
    pub sphere_holds_set: bool,
    /// Half width of the cone about a shadow ray that a blocker has to fill.
    ///
    /// Per unit of distance to the shaded point. The default is half the sun's apparent size.
    pub shadow_cone: f32,
    /// Least clearance of an unblocked shadow ray, in hit distances of the shaded point.
    pub shadow_margin: f32,
    /// Least step of a shadow ray, in hit distances of the shaded point.
    pub shadow_min_step: f32,
}

impl Default for MarchPolicy {
    fn default() -> Self {
        Self {
            relaxation: 1.4,
            ball_part: 1.0,
            checks_hits: false,
            sphere_holds_set: false,
            shadow_cone: 0.004,
            shadow_margin: 0.5,
            shadow_min_step: 0.0,
        }
    }
}

/// Limits of steps that come from an orbit's Jacobian at one point, which holds only near that point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepLimits {
    /// [`MarchPolicy::ball_part`] with such steps.
    pub ball_part: f32,
    /// Radius of the largest ball that a ray takes for empty, over the radius of the ball before; at least 1.
    ///
    /// The stretch along the ray limits a step. It vanishes where a coordinate of an orbit has an extremum along the
    /// ray, and then any step is within that limit. Balls shrink before such a point, so that the limit of their
    /// growth holds at the point itself.
    pub ball_growth: f32,
}

/// Distance estimate at a point, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Estimated distance to the surface; 0 inside.
    pub distance: f64,
    /// Longest safe step of a ray, at most `distance`.
    pub step: f64,
}

/// A field of distances to a surface. All points are relative to [`Self::origin`].
pub trait DistanceField: Send + Sync {
    /// The origin of the field's coordinates; by default the scene's origin.
    fn origin(&self) -> PrecisePoint {
        PrecisePoint::ORIGIN
    }

    /// `point` in the field's coordinates, from an exact difference.
    fn local(&self, point: &PrecisePoint) -> DVec3 {
        point - &self.origin()
    }

    /// Least radius of a pixel's cone that the field can draw, in scene units.
    ///
    /// Navigation comes no nearer than this allows.
    fn finest_footprint(&self) -> f64 {
        PLAIN_FOOTPRINT
    }

    /// Estimated distance from `point` to the surface, in scene units; 0 inside.
    fn distance(&self, point: DVec3) -> f64;

    /// Whether the set holds `point`; by default where the distance is 0.
    fn is_inside(&self, point: DVec3) -> bool {
        self.distance(point) <= 0.0
    }

    /// [`Self::distance`] and the safe step, by default the whole distance.
    fn estimate(&self, point: DVec3) -> Estimate {
        let distance = self.distance(point);
        Estimate { distance, step: distance }
    }

    /// The first positions of the orbit of `point`, at most `length`; it ends where orbits escape.
    ///
    /// Empty if the formula's steps have no derivatives there.
    fn orbit(&self, _point: DVec3, _length: usize) -> Vec<OrbitPosition> {
        Vec::new()
    }

    /// Centre of a sphere that holds the surface.
    fn center(&self) -> DVec3 {
        DVec3::ZERO
    }

    /// Radius of a sphere about [`Self::center`] that holds the surface that is drawn, in scene units.
    fn bounding_radius(&self) -> f64;

    /// True if the estimate has false minima thinner than a pixel.
    ///
    /// Hits are then checked over half a hit distance.
    fn needs_hit_check(&self) -> bool {
        false
    }

    /// [`Self::distance`], clamped where the estimate is far too large: most often outside the bounding sphere.
    ///
    /// There the result lies between the distances to the sphere and to its centre; inside, the sphere's far side is the
    /// farthest. For speeds and collisions; rays start at the sphere and need no clamp.
    fn clear_distance(&self, point: DVec3) -> f64 {
        self.clear_estimate(point).distance
    }

    /// [`Self::estimate`], clamped like [`Self::clear_distance`].
    fn clear_estimate(&self, point: DVec3) -> Estimate {
        let from_centre = point.distance(self.center());
        let to_sphere = from_centre - self.bounding_radius();
        let [least, most] = if to_sphere > 0.0 {
            [to_sphere, from_centre]
        } else {
            [f64::NEG_INFINITY, from_centre + self.bounding_radius()]
        };
        let mend = |length: f64| length.max(least).min(most);
        let Estimate { distance, step } = self.estimate(point);
        Estimate { distance: mend(distance), step: mend(step) }
    }

    /// Sphere-traces `ray` and returns the depth of the first hit.
    ///
    /// `cone` is the hit distance per unit of depth (not negative); the march stops at `max_depth`. A ray
    /// that starts inside hits at depth zero.
    fn march(&self, ray: Ray, cone: f64, max_depth: f64) -> Option<f64> {
        self.trace(ray, cone, max_depth, MAX_MARCH_STEPS).unwrap_or(None)
    }

    /// [`Self::march`] with at most `max_steps` steps.
    ///
    /// # Errors
    /// The ray's depth after `max_steps`, if it neither hit nor left: it creeps along the surface.
    fn trace(
        &self,
        ray: Ray,
        cone: f64,
        max_depth: f64,
        max_steps: u32,
    ) -> Result<Option<f64>, f64> {
        trace(self, ray, cone, max_depth, max_steps)
    }

    /// The depth between `before` and `hit` at which the ray crosses the hit distance.
    ///
    /// None unless the ray stays within the hit distance for [`CHECKED_THICKNESS`] hit distances. At `hit` it is within.
    fn lasting_hit(&self, ray: Ray, cone: f64, [mut before, mut hit]: [f64; 2]) -> Option<f64> {
        let is_near = |depth: f64| self.distance(ray.at(depth)) <= cone * depth;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + hit);
            *(if is_near(middle) { &mut hit } else { &mut before }) = middle;
        }
        let place = |k: u32| {
            hit * (1.0 + cone * CHECKED_THICKNESS * f64::from(k) / f64::from(THICKNESS_CHECKS))
        };
        (1..=THICKNESS_CHECKS).all(|k| is_near(place(k))).then_some(hit)
    }

    /// The depth at which a ray comes closest to the surface.
    ///
    /// The search takes at most `max_steps` steps. Closest as seen from the ray's origin: least
    /// distance over depth. A ray that comes within the hit distance, `cone` per unit of depth,
    /// ends there. The depth is at least zero.
    fn closest_approach(&self, ray: Ray, cone: f64, max_steps: u32) -> f64 {
        let Some((near, far)) = ray.sphere_span(self.center(), self.bounding_radius()) else {
            return ray.depth_beside(self.center()).max(0.0);
        };
        let (mut depth, mut best, mut best_ratio) = (near, near, f64::INFINITY);
        for _ in 0..max_steps {
            if depth > far {
                break;
            }
            let Estimate { distance, step } = self.estimate(ray.at(depth));
            let ratio = distance / depth.max(f64::MIN_POSITIVE);
            if ratio < best_ratio {
                (best, best_ratio) = (depth, ratio);
            }
            if ratio <= cone {
                break;
            }
            // At least a quarter of the estimate: a crawl takes too long, and the exact minimum does not matter.
            depth += step.max(0.25 * distance);
        }
        best
    }

    /// The unit normal at `point` from six samples at ± `spacing` on the main axes.
    ///
    /// Source: thesis figure 3.3 c. If the differences vanish, the normal points away from the bounding
    /// sphere's centre.
    fn normal(&self, point: DVec3, spacing: f64) -> DVec3 {
        let slope = |axis: DVec3| {
            self.distance(point + axis * spacing) - self.distance(point - axis * spacing)
        };
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z))
            .try_normalize()
            .unwrap_or_else(|| (point - self.center()).normalize_or(DVec3::Z))
    }
}

/// [`DistanceField::trace`] by the field's estimates alone.
///
/// # Errors
/// The ray's depth after `max_steps`, as there.
pub fn trace<F: DistanceField + ?Sized>(
    field: &F,
    ray: Ray,
    cone: f64,
    max_depth: f64,
    max_steps: u32,
) -> Result<Option<f64>, f64> {
    let Some((near, far)) = ray.sphere_span(field.center(), field.bounding_radius()) else {
        return Ok(None);
    };
    let far = far.min(max_depth);
    let min_step = if field.needs_hit_check() { MIN_STEP_WITH_HIT_CHECK } else { MIN_STEP };
    let (mut before, mut depth) = (near, near);
    for i in 0..max_steps {
        if depth > far {
            return Ok(None);
        }
        let (estimate, hit) = (field.estimate(ray.at(depth)), cone * depth);
        let escalated_step = step_escalation(f64::from(i) / f64::from(max_steps))
            * estimate.distance.min(field.bounding_radius());
        if estimate.distance <= hit {
            if !field.needs_hit_check() {
                return Ok(Some(depth));
            }
            if let Some(depth) = field.lasting_hit(ray, cone, [before, depth]) {
                return Ok(Some(depth));
            }
        }
        before = depth;
        depth += estimate.step.max(escalated_step).max(min_step * hit);
    }
    Err(depth)
}

/// Least step over the estimate, or over the bounding radius if that is less, after the part `spent` of a ray's steps.
///
/// A Julia set's estimates in front of the origin are far longer than any way through the set.
///
/// At power 3, orbits that pass the axis repeatedly have safe steps hundreds of times shorter than their
/// estimates; rays that use only safe steps run out of steps before they hit. The fourth power barely
/// changes rays that take a third of their steps.
fn step_escalation(spent: f64) -> f64 {
    spent.powi(4)
}

/// A half-line in a field's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The ray's start.
    pub origin: DVec3,
    /// The ray's direction: a unit vector.
    pub direction: DVec3,
}

impl Ray {
    /// The point at `depth`.
    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }

    /// The depth at which the ray comes closest to `point`; negative if behind.
    fn depth_beside(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.direction)
    }

    /// Entry and exit depths of the sphere of `radius` about `center`; none if the ray misses.
    ///
    /// The entry depth is at least zero.
    pub fn sphere_span(&self, center: DVec3, radius: f64) -> Option<(f64, f64)> {
        let middle = self.depth_beside(center);
        // The foot of the perpendicular avoids the cancellation of large squares for a far eye.
        let half_chord_squared = radius * radius - self.at(middle).distance_squared(center);
        let half_chord = half_chord_squared.max(0.0).sqrt();
        (half_chord_squared > 0.0 && middle + half_chord > 0.0)
            .then(|| ((middle - half_chord).max(0.0), middle + half_chord))
    }
}
