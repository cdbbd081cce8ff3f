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
    /// The vector from the eye to the nearest hit so far.
    nearest: Option<DVec3>,
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
        Self { reference, field, ray: 0, steps: 0, depth: 0.0, nearest: None }
    }

    /// Marches the current ray by a few steps; returns false after the last ray.
    fn step(&mut self, camera: &Camera, aspect: f64) -> bool {
        let ray = camera_ray(camera, &self.field.origin(), ndc(self.ray), aspect);
        let direction = ray.direction;
        for _ in 0..STEPS_AT_ONCE {
            let point = ray.at(self.depth);
            let estimate = self.field.estimate(point);
            let is_hit = estimate.distance <= NEARNESS * self.depth;
            if is_hit && self.depth > 0.0 {
                self.nearest = Some(direction * self.depth);
            }
            let from_center = point - self.field.center();
            let has_left = from_center.length() > self.field.bounding_radius()
                && from_center.dot(direction) > 0.0;
            let nearest = self.nearest.map_or(f64::INFINITY, DVec3::length);
            self.steps += 1;
            if is_hit || has_left || self.depth > nearest || self.steps >= MAX_STEPS {
                (self.ray, self.steps, self.depth) = (self.ray + 1, 0, 0.0);
                return self.ray < RAYS;
            }
            self.depth += estimate.step.max(0.25 * estimate.distance);
        }
        true
    }
}

/// Where a ray passes through the picture: the first through its middle, the others on a spiral.
fn ndc(ray: u32) -> DVec2 {
    0.85 * in_disc(ray, RAYS - 1)
}
