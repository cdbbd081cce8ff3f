//! Finds the anchor of a view: a point of the visible surface.
//!
//! The search marches rays in f64 about an older anchor that is near enough, or about the eye itself:
//! the eye's orbit lasts as long as the orbits of points as far from it as the surface is. Only the
//! orbits of the eye and of the found point take many digits. The search runs in small steps, so
//! that a frame can run as many as fit its time.

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
/// Longest step past the safe one, as a part of the depth.
///
/// A ray that only takes safe steps creeps through dust.
const LEAP: f64 = 0.05;
/// Largest distance over depth at which a ray that passes a surface is beside it.
const PASSED: f64 = 0.05;
/// Growth of that ratio over its least value, after which the ray has passed.
const LEAVING: f64 = 4.0;
/// Most steps from a ray to a surface beside it.
///
/// Each leaves at most a third of the distance where estimates are at least half the distance.
const LANDING_STEPS: u32 = 16;
/// March steps per step of the search: about a tenth of a millisecond.
const STEPS_AT_ONCE: u32 = 16;
/// Greatest distance from the eye to an older anchor that f64 rays can use.
///
/// In distances from the eye to the surface.
const NEAR_ENOUGH: f64 = 1e6;
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
    /// The ray's closest approach to a surface that it has not left yet.
    closest: Option<Approach>,
    /// The way to a surface that the ray has passed.
    landing: Option<Landing>,
    /// The vector from the eye to the nearest hit so far.
    nearest: Option<DVec3>,
}

/// Where a ray is closest to a surface.
#[derive(Clone, Copy)]
struct Approach {
    point: DVec3,
    /// Distance to the surface over the depth.
    nearness: f64,
}

/// A point on its way from a ray to a surface, by Newton's method along the normal.
struct Landing {
    point: DVec3,
    steps: u32,
}

impl Landing {
    /// Takes a step; returns the distance to the surface before it.
    fn step(&mut self, field: &dyn DistanceField) -> f64 {
        let distance = field.distance(self.point);
        let spacing = 0.01 * distance;
        let inward = -field.normal(self.point, spacing);
        // Estimates in dust are many times the distance.
        let slope = (distance - field.distance(self.point + inward * spacing)) / spacing;
        self.point += inward * (distance / slope.max(0.75));
        self.steps += 1;
        distance
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
                // With no surface in view, the eye is as good an anchor as any point.
                let way = rays.nearest.unwrap_or(DVec3::ZERO);
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
            closest: None,
            landing: None,
            nearest: None,
        }
    }

    /// Marches the current ray by a few steps; returns false after the last ray.
    fn step(&mut self, camera: &Camera, aspect: f64) -> bool {
        let ray = camera_ray(camera, &self.field.origin(), ndc(self.ray), aspect);
        if self.landing.is_some() {
            return self.land(ray.origin);
        }
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
            self.steps += 1;
            if is_hit || has_left || self.depth > nearest || self.steps >= MAX_STEPS {
                return self.next_ray();
            }
            if let Some(point) = self.passed(point, estimate.distance) {
                self.landing = Some(Landing { point, steps: 0 });
                return true;
            }
            self.depth += estimate.step.max((0.25 * estimate.distance).min(LEAP * self.depth));
        }
        true
    }

    /// The point beside a surface that the ray has passed on its way to `point`, if it has.
    ///
    /// Steps may pass dust, which is thinner than they are long.
    fn passed(&mut self, point: DVec3, distance: f64) -> Option<DVec3> {
        let nearness = distance / self.depth.max(f64::MIN_POSITIVE);
        match self.closest {
            Some(closest) if nearness > LEAVING * closest.nearness => {
                self.closest = None;
                Some(closest.point)
            }
            Some(closest) if nearness >= closest.nearness => None,
            _ => {
                self.closest = (nearness < PASSED).then_some(Approach { point, nearness });
                None
            }
        }
    }

    /// Goes on from a ray that starts at `eye` to the surface beside it; returns false after the last ray.
    fn land(&mut self, eye: DVec3) -> bool {
        let Some(landing) = &mut self.landing else { return true };
        let way = landing.point - eye;
        if landing.step(&*self.field) <= NEARNESS * way.length() {
            self.nearest = self
                .nearest
                .filter(|nearest| nearest.length_squared() < way.length_squared())
                .or(Some(way));
            return self.next_ray();
        }
        if landing.steps >= LANDING_STEPS {
            self.landing = None;
        }
        true
    }

    /// Goes on to the next ray; returns false after the last.
    fn next_ray(&mut self) -> bool {
        (self.ray, self.steps, self.depth) = (self.ray + 1, 0, 0.0);
        (self.closest, self.landing) = (None, None);
        self.ray < RAYS
    }
}

/// Where a ray passes through the picture: the first through its middle, the others on a spiral.
fn ndc(ray: u32) -> DVec2 {
    0.85 * in_disc(ray, RAYS - 1)
}
