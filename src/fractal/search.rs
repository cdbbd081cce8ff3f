//! Finds the anchor of a view: a point of the visible surface, or one in front of the eye if no surface is near.
//!
//! The search marches rays in f64 about an older anchor that is near enough, or about the eye itself:
//! the eye's orbit lasts as long as the orbits of points as far from it as the surface is. Only the
//! orbits of the eye and of the found point take many digits. The search runs in small steps, so
//! that a frame can run as many as fit its time.
//!
//! [`nearest_depth`] sphere-traces rays in the same directions, without the search for dust beside them.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{camera_ray, spiral::in_disc};
use crate::{
    formula::{DistanceField, ReferenceOrbit, ReferenceSteps, march::DEEP_FOOTPRINT},
    scene::{Camera, Fractal, PrecisePoint},
};

/// Distance from an anchor to the surface, as a part of the anchor's depth.
///
/// The eye can come nearer by this factor before other orbits outlast the anchor's.
const NEARNESS: f64 = 1e-7;
/// Number of rays; the first passes through the picture's middle.
const RAYS: u32 = 9;
/// Most steps of one ray; a ray with more creeps along the surface.
const MAX_STEPS: u32 = 600;
/// Most steps of one ray of [`nearest_depth`], which takes no steps between frames.
const MAX_TRACE_STEPS: u32 = 128;
/// Longest step, over the depth, that is longer than the safe step.
///
/// A ray that only takes safe steps creeps through dust.
const LEAP: f64 = 0.05;
/// Distance from a ray to a surface beside it that is in the picture for certain.
///
/// Per unit of depth, over half the picture's shorter side there. Rays are at most 0.85 of the way to the picture's border.
const BESIDE: f64 = 0.15;
/// Growth of the distance over depth, from its least value on, after which a ray has passed a surface.
const PASSED_GROWTH: f64 = 4.0;
/// Most steps from a ray to a surface beside it: enough to halve a distance that is beside it until it is a hit.
const MAX_PROJECTION_STEPS: u32 = 32;
/// March steps per step of the search: about a tenth of a millisecond.
const STEPS_AT_ONCE: u32 = 16;
/// Greatest distance from the eye to an older anchor that f64 rays can use.
///
/// In distances from the eye to the surface.
const NEAR_ENOUGH: f64 = 1e6;
/// Depth of the farthest usable hit, over the distance to the pivot.
///
/// If the nearest hit is farther, all rays have passed dust near the eye, or the pivot is in the open. An anchor as near as
/// the pivot draws what is far away as well.
const MAX_HIT_DEPTH: f64 = 100.0;
/// Rounding of the anchor's position, as a part of its depth: its exact position does not matter.
const GRAIN: f64 = 1e-12;

/// Finest detail that the rays resolve, over the eye's distance to the surface.
const GRAIN_SEEN: f64 = 1e-4;

/// A search in progress.
pub struct Search {
    fractal: Fractal,
    camera: Camera,
    aspect: f64,
    stage: Stage,
}

enum Stage {
    /// Computes the eye's orbit.
    Eye(Option<Box<dyn ReferenceSteps>>),
    /// Marches rays about the older anchor or the eye.
    Rays(RayMarch),
    /// Computes the orbit of the found point.
    Anchor(Option<Box<dyn ReferenceSteps>>),
    Found(Arc<dyn ReferenceOrbit>),
}

struct RayMarch {
    reference: Arc<dyn ReferenceOrbit>,
    field: Arc<dyn DistanceField>,
    /// Index of the current ray; its steps and depth follow.
    ray: u32,
    steps: u32,
    depth: f64,
    /// The distance estimate at the eye, or the distance to the pivot if that is less: in dust and in Julia sets the
    /// estimate may be thousands of times the distance.
    near: f64,
    /// The ray's closest approach to a surface that it has not passed yet.
    closest: Option<Approach>,
    /// The way to a surface that the ray has passed.
    projection: Option<SurfaceProjection>,
    /// The vector from the eye to the nearest hit so far.
    nearest: Option<DVec3>,
}

/// Where a ray is closest to a surface.
#[derive(Clone, Copy)]
struct Approach {
    point: DVec3,
    /// Distance to the surface over the depth.
    ratio: f64,
}

/// A point on its way from a ray to a surface beside it.
struct SurfaceProjection {
    point: DVec3,
    /// The last point outside the set.
    outside: DVec3,
    steps: u32,
}

impl SurfaceProjection {
    fn from(point: DVec3) -> Self {
        Self { point, outside: point, steps: 0 }
    }

    /// Returns the point if it is at the surface, within `hit`; else takes a step: of Newton's method along the normal,
    /// or halfway back from inside the set.
    fn step(&mut self, field: &dyn DistanceField, hit: f64) -> Option<DVec3> {
        self.steps += 1;
        let distance = field.distance(self.point);
        if distance <= 0.0 {
            if self.point.distance(self.outside) <= hit {
                return Some(self.point);
            }
            self.point = self.point.midpoint(self.outside);
            return None;
        }
        if distance <= hit {
            return Some(self.point);
        }
        let spacing = 0.01 * distance;
        let inward = -field.normal(self.point, spacing);
        // Estimates in dust are many times the distance.
        let slope = (distance - field.distance(self.point + inward * spacing)) / spacing;
        self.outside = self.point;
        self.point += inward * (distance / slope.max(0.75));
        None
    }
}

impl Search {
    /// A search for an anchor of what `camera` sees of `fractal`; none if the views have no depth.
    ///
    /// `aspect` is the picture's width over its height. The search uses `older`, an older anchor, if that
    /// belongs to the same set and is near enough.
    pub fn new(
        fractal: &Fractal,
        camera: &Camera,
        aspect: f64,
        older: Option<&Arc<dyn ReferenceOrbit>>,
    ) -> Option<Self> {
        let helpful = older.filter(|older| older.is_of(fractal)).filter(|&older| {
            let field = fractal.field_about(older.clone(), DEEP_FOOTPRINT, DEEP_FOOTPRINT);
            let eye = &camera.position - older.anchor();
            eye.length() < NEAR_ENOUGH * field.distance(eye)
        });
        let stage = match helpful {
            Some(older) => Stage::Rays(RayMarch::new(older.clone(), fractal, camera)),
            None => Stage::Eye(Some(begun(fractal, &camera.position)?)),
        };
        Some(Self { fractal: fractal.clone(), camera: camera.clone(), aspect, stage })
    }

    /// Runs one step of about 0.1 ms; returns the reference orbit once the anchor is found.
    pub fn step(&mut self) -> Option<Arc<dyn ReferenceOrbit>> {
        let next = match &mut self.stage {
            Stage::Eye(steps) => {
                let eye = finished(steps)?;
                Stage::Rays(RayMarch::new(eye, &self.fractal, &self.camera))
            }
            Stage::Rays(rays) => {
                if rays.step(&self.camera, self.aspect) {
                    return None;
                }
                let far = MAX_HIT_DEPTH * self.camera.view_unit();
                let hit = rays.nearest.filter(|way| way.length() <= far);
                // With no surface near enough, a point in front of the eye is as good an anchor as any.
                let way = hit.unwrap_or(rays.near * self.camera.forward());
                let anchor = self.camera.position.moved_by(way, GRAIN * way.length());
                match begun(&self.fractal, &anchor) {
                    Some(steps) => Stage::Anchor(Some(steps)),
                    None => Stage::Found(rays.reference.clone()),
                }
            }
            Stage::Anchor(steps) => Stage::Found(finished(steps)?),
            Stage::Found(reference) => return Some(reference.clone()),
        };
        self.stage = next;
        None
    }

    /// Runs the remaining steps and returns the anchor's reference orbit.
    pub fn finish(mut self) -> Arc<dyn ReferenceOrbit> {
        loop {
            if let Some(reference) = self.step() {
                return reference;
            }
        }
    }
}

/// Begins the orbit of `anchor`.
fn begun(fractal: &Fractal, anchor: &PrecisePoint) -> Option<Box<dyn ReferenceSteps>> {
    fractal.formula().begin_reference(fractal, anchor.clone())
}

/// Computes the next step of an orbit; returns the orbit after the last.
fn finished(steps: &mut Option<Box<dyn ReferenceSteps>>) -> Option<Arc<dyn ReferenceOrbit>> {
    if steps.as_mut()?.step() { None } else { Some(steps.take()?.finish()) }
}

/// Depth of the nearest hit of a search's nine rays, at most `max_depth`.
///
/// `aspect` is the picture's width over its height, `cone` the hit distance per unit of depth. A ray that runs out of
/// steps counts as a hit where it stops.
pub fn nearest_depth(
    field: &dyn DistanceField,
    camera: &Camera,
    aspect: f64,
    cone: f64,
    max_depth: f64,
) -> f64 {
    (0..RAYS).fold(max_depth, |nearest, ray| {
        let ray = camera_ray(camera, &field.origin(), ndc(ray), aspect);
        match field.trace(ray, cone, nearest, MAX_TRACE_STEPS) {
            Ok(Some(depth)) | Err(depth) => depth.min(nearest),
            Ok(None) => nearest,
        }
    })
}

impl RayMarch {
    fn new(reference: Arc<dyn ReferenceOrbit>, fractal: &Fractal, camera: &Camera) -> Self {
        let field = fractal.field_about(reference.clone(), DEEP_FOOTPRINT, DEEP_FOOTPRINT);
        let away = field.distance(&camera.position - &field.origin());
        let field = fractal.field_about(reference.clone(), DEEP_FOOTPRINT, GRAIN_SEEN * away);
        Self {
            reference,
            field,
            ray: 0,
            steps: 0,
            depth: 0.0,
            near: away.min(camera.view_unit()),
            closest: None,
            projection: None,
            nearest: None,
        }
    }

    /// Marches the current ray by a few steps; returns false after the last ray.
    fn step(&mut self, camera: &Camera, aspect: f64) -> bool {
        let ray = camera_ray(camera, &self.field.origin(), ndc(self.ray), aspect);
        if self.projection.is_some() {
            return self.project(ray.origin);
        }
        let beside = BESIDE * camera.half_height(aspect) * aspect.min(1.0);
        let nearest = self.nearest.map_or(f64::INFINITY, DVec3::length);
        for _ in 0..STEPS_AT_ONCE {
            let point = ray.at(self.depth);
            let estimate = self.field.estimate(point);
            let is_hit = estimate.distance <= NEARNESS * self.depth;
            if is_hit && self.depth > 0.0 && self.depth < nearest {
                self.nearest = Some(ray.direction * self.depth);
            }
            let from_center = point - self.field.center();
            let has_left = from_center.length() > self.field.bounding_radius()
                && from_center.dot(ray.direction) > 0.0;
            if is_hit || has_left || self.depth > nearest {
                return self.next_ray();
            }
            self.steps += 1;
            let is_last = self.steps >= MAX_STEPS;
            if let Some(closest) = self.passed(point, estimate.distance, beside, is_last) {
                self.projection = Some(SurfaceProjection::from(closest));
                return true;
            }
            if is_last {
                return self.next_ray();
            }
            // The depth alone would let no step grow at the eye.
            let leap = LEAP * self.depth.max(LEAP * self.near);
            self.depth += estimate.step.max((0.25 * estimate.distance).min(leap));
        }
        true
    }

    /// Updates the ray's closest approach by a point of it; returns that approach if the ray has passed the surface, or
    /// the point is its last.
    ///
    /// Dust may be thinner than steps are long: no point of the ray is a hit.
    fn passed(&mut self, point: DVec3, distance: f64, beside: f64, is_last: bool) -> Option<DVec3> {
        let ratio = distance / self.depth.max(f64::MIN_POSITIVE);
        if ratio < self.closest.map_or(beside, |closest| closest.ratio) {
            self.closest = Some(Approach { point, ratio });
        }
        self.closest
            .take_if(|closest| is_last || ratio > PASSED_GROWTH * closest.ratio)
            .map(|closest| closest.point)
    }

    /// Goes on from a ray that starts at `eye` to the surface beside it; returns false after the last ray.
    fn project(&mut self, eye: DVec3) -> bool {
        let Some(projection) = &mut self.projection else { return true };
        let hit = NEARNESS * projection.point.distance(eye);
        if let Some(point) = projection.step(&*self.field, hit) {
            let way = point - eye;
            let is_nearer = self.nearest.is_none_or(|nearest| way.length() < nearest.length());
            if is_nearer {
                self.nearest = Some(way);
            }
            return self.next_ray();
        }
        self.steps += 1;
        if projection.steps < MAX_PROJECTION_STEPS {
            return true;
        }
        self.projection = None;
        self.steps < MAX_STEPS || self.next_ray()
    }

    /// Goes on to the next ray; returns false after the last.
    fn next_ray(&mut self) -> bool {
        (self.ray, self.steps, self.depth) = (self.ray + 1, 0, 0.0);
        (self.closest, self.projection) = (None, None);
        self.ray < RAYS
    }
}

/// Where a ray passes through the picture: the first through its middle, the others on a spiral.
fn ndc(ray: u32) -> DVec2 {
    0.85 * in_disc(ray, RAYS - 1)
}
