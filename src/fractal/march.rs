//! Rays against a distance field: sphere tracing, normals, and what lies under a pixel.
//!
//! Conventions, shared with the kernels: pixel (x, y) is seen through its centre
//! (x + 0.5, y + 0.5); normalised device coordinates run from −1 to 1, x right and y up;
//! depth is Euclidean distance along the unit ray. A pixel's cone has the radius
//! `half_height / height_px` per unit of depth, half the pixel's width; a ray has hit where the
//! distance is below that cone's radius times the scene's detail setting, at low powers for half of
//! that length along the ray.
//!
//! Points are vectors in scene units from the field's own origin ([`DistanceField::origin`]): near
//! a deep place that origin is near too, so that an f64 tells apart what a picture there shows.

use glam::{DVec2, DVec3};

use crate::scene::{Camera, PrecisePoint};

/// The least radius of a pixel's cone at the surface, in scene units, where plain f32 pictures hold.
pub const PLAIN_FOOTPRINT: f64 = 2e-7;

/// The same at the end of the deepest dive: with it, a picture 1000 pixels high at the usual field
/// of view has its eye 1e-27 scene units from the surface.
pub const DEEP_FOOTPRINT: f64 = 4e-31;

/// Most steps of one ray; one that is still travelling then counts as a miss.
pub const MAX_MARCH_STEPS: u32 = 4096;

/// No step of a ray is shorter than this part of the hit distance; what is thinner may be passed.
pub const LEAST_STEP: f64 = 0.25;
/// The same where a hit has to last ([`DistanceField::needs_hit_check`]).
pub const LEAST_STEP_WITH_HIT_CHECK: f64 = 0.4;
/// How long it has to, in hit distances.
pub const THICK: f64 = 0.5;
/// At how many places that is asked.
pub const THICK_PLACES: u32 = 6;
/// Halvings of the step that crossed the hit distance, so that these places lie where they should.
pub const HALVINGS: u32 = 5;

/// Distance estimate at a point, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Estimated distance to the surface; zero inside.
    pub distance: f64,
    /// How far a ray may safely go, at most `distance`.
    pub step: f64,
}

/// Anything that can say how far away its surface is. All points are relative to [`Self::origin`].
pub trait DistanceField {
    /// What points are measured from; the scene's origin unless the field says otherwise.
    fn origin(&self) -> PrecisePoint {
        PrecisePoint::ORIGIN
    }

    /// `point` in the field's coordinates: the difference is formed exactly.
    fn local(&self, point: &PrecisePoint) -> DVec3 {
        point - &self.origin()
    }

    /// The least radius of a pixel's cone at the surface, in scene units, that pictures of this
    /// field hold for: no movement comes nearer.
    fn finest_footprint(&self) -> f64 {
        PLAIN_FOOTPRINT
    }

    /// Estimated distance from `point` to the surface, in scene units; zero inside.
    fn distance(&self, point: DVec3) -> f64;

    /// [`Self::distance`] and the safe step; a step of the whole distance unless the field overrides it.
    fn estimate(&self, point: DVec3) -> Estimate {
        let distance = self.distance(point);
        Estimate { distance, step: distance }
    }

    /// Centre of a sphere that holds all of the surface.
    fn center(&self) -> DVec3 {
        DVec3::ZERO
    }

    /// Radius of that sphere, in scene units.
    fn bounding_radius(&self) -> f64;

    /// True if the estimate has false minima thinner than a pixel. Hits are then checked over half a hit
    /// distance.
    fn needs_hit_check(&self) -> bool {
        false
    }

    /// [`Self::distance`], mended where the estimate is far too large: past the bounding sphere,
    /// never less than the way to it, never more than the way to its centre. For speeds and
    /// collisions; rays need it not, since they start at the sphere.
    fn clear_distance(&self, point: DVec3) -> f64 {
        self.clear_estimate(point).distance
    }

    /// [`Self::estimate`], mended like [`Self::clear_distance`].
    fn clear_estimate(&self, point: DVec3) -> Estimate {
        let from_centre = point.distance(self.center());
        let to_sphere = from_centre - self.bounding_radius();
        let Estimate { distance, step } = self.estimate(point);
        if to_sphere > 0.0 {
            let mend = |length: f64| length.clamp(to_sphere, from_centre);
            Estimate { distance: mend(distance), step: mend(step) }
        } else {
            Estimate { distance, step }
        }
    }

    /// Sphere-traces `ray` and returns the depth of the first hit. `cone` is the hit distance
    /// per unit of depth (not negative); nothing past `max_depth` is looked at. A ray that
    /// starts inside has hit at depth zero.
    fn march(&self, ray: Ray, cone: f64, max_depth: f64) -> Option<f64> {
        self.trace(ray, cone, max_depth, MAX_MARCH_STEPS).unwrap_or(None)
    }

    /// [`Self::march`] by at most `max_steps`.
    ///
    /// # Errors
    /// The depth of a ray that is still travelling then: it creeps along something.
    fn trace(
        &self,
        ray: Ray,
        cone: f64,
        max_depth: f64,
        max_steps: u32,
    ) -> Result<Option<f64>, f64> {
        let Some((near, far)) = ray.sphere_span(self.center(), self.bounding_radius()) else {
            return Ok(None);
        };
        let far = far.min(max_depth);
        let least_step =
            if self.needs_hit_check() { LEAST_STEP_WITH_HIT_CHECK } else { LEAST_STEP };
        let (mut before, mut depth) = (near, near);
        for i in 0..max_steps {
            if depth > far {
                return Ok(None);
            }
            let (estimate, hit) = (self.estimate(ray.at(depth)), cone * depth);
            let escalated_step =
                step_escalation(f64::from(i) / f64::from(max_steps)) * estimate.distance;
            if estimate.distance <= hit {
                if !self.needs_hit_check() {
                    return Ok(Some(depth));
                }
                if let Some(depth) = self.lasting_hit(ray, cone, [before, depth]) {
                    return Ok(Some(depth));
                }
            }
            before = depth;
            depth += estimate.step.max(escalated_step).max(least_step * hit);
        }
        Err(depth)
    }

    /// Where between two depths, of which the second is within the hit distance, the ray comes that
    /// near, if it stays so for [`THICK`] hit distances.
    fn lasting_hit(&self, ray: Ray, cone: f64, [mut before, mut hit]: [f64; 2]) -> Option<f64> {
        let is_near = |depth: f64| self.distance(ray.at(depth)) <= cone * depth;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + hit);
            *(if is_near(middle) { &mut hit } else { &mut before }) = middle;
        }
        let place = |k: u32| hit * (1.0 + cone * THICK * f64::from(k) / f64::from(THICK_PLACES));
        (1..=THICK_PLACES).all(|k| is_near(place(k))).then_some(hit)
    }

    /// Where along `ray` it comes closest to the surface as seen from its origin (least
    /// distance over depth), for a ray that misses: a depth of at least zero.
    fn closest_approach(&self, ray: Ray, max_depth: f64) -> f64 {
        let Some((near, far)) = ray.sphere_span(self.center(), self.bounding_radius()) else {
            return ray.depth_beside(self.center()).clamp(0.0, max_depth);
        };
        let far = far.min(max_depth);
        let (mut depth, mut best, mut best_ratio) = (near, near, f64::INFINITY);
        for _ in 0..MAX_MARCH_STEPS {
            if depth > far {
                break;
            }
            let Estimate { distance, step } = self.estimate(ray.at(depth));
            let ratio = distance / depth.max(f64::MIN_POSITIVE);
            if ratio < best_ratio {
                (best, best_ratio) = (depth, ratio);
            }
            if distance <= 0.0 {
                break;
            }
            // Short of nothing that matters here, and no crawling along the surface.
            depth += step.max(0.25 * distance);
        }
        best
    }

    /// The unit normal at `point` from six samples at ± `spacing` on the main axes (thesis
    /// figure 3.3 c). Where they say nothing, the direction away from the bounding sphere's centre.
    fn normal(&self, point: DVec3, spacing: f64) -> DVec3 {
        let slope = |axis: DVec3| {
            self.distance(point + axis * spacing) - self.distance(point - axis * spacing)
        };
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z))
            .try_normalize()
            .unwrap_or_else(|| (point - self.center()).normalize_or(DVec3::Z))
    }
}

/// What part of the estimate a step covers at least where this part of a ray's steps is spent.
///
/// At power 3 orbits that come by the axis again and again have safe steps hundreds of times shorter
/// than their estimates, and rays that went by these alone ended in the air when their steps were spent.
/// The fourth power leaves rays that take a third of their steps as they are.
fn step_escalation(spent: f64) -> f64 {
    spent.powi(4)
}

/// A half-line in a field's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes: a unit vector.
    pub direction: DVec3,
}

impl Ray {
    /// The point at `depth`.
    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }

    /// The depth at which it comes closest to `point`; negative if behind.
    fn depth_beside(&self, point: DVec3) -> f64 {
        (point - self.origin).dot(self.direction)
    }

    /// Entry and exit depths of the sphere of `radius` about `center`, the entry no less than
    /// zero; none where the ray misses it.
    pub fn sphere_span(&self, center: DVec3, radius: f64) -> Option<(f64, f64)> {
        let middle = self.depth_beside(center);
        // The foot of the perpendicular: no cancellation of large squares for a far eye.
        let half_chord_squared = radius * radius - self.at(middle).distance_squared(center);
        let half_chord = half_chord_squared.max(0.0).sqrt();
        (half_chord_squared > 0.0 && middle + half_chord > 0.0)
            .then(|| ((middle - half_chord).max(0.0), middle + half_chord))
    }
}

/// The ray through `ndc` of a picture whose width over height is `aspect`, in coordinates relative
/// to `origin` (a field's [`DistanceField::origin`]).
pub fn camera_ray(camera: &Camera, origin: &PrecisePoint, ndc: DVec2, aspect: f64) -> Ray {
    let half_height = camera.half_height(aspect);
    let in_camera = DVec3::new(ndc.x * aspect * half_height, ndc.y * half_height, -1.0);
    Ray { origin: &camera.position - origin, direction: camera.rotation() * in_camera.normalize() }
}

/// The radius of one pixel's cone per unit of depth, for a picture `height_px` pixels high whose
/// width over height is `aspect`.
pub fn pixel_cone(camera: &Camera, aspect: f64, height_px: f64) -> f64 {
    camera.half_height(aspect) / height_px.max(1.0)
}
