//! The anchor of a view: a point of the surface that it shows.
//!
//! Rays are marched in f64 about an older anchor that is near enough, or about the eye itself,
//! whose orbit lasts as long as those of points as far from it as the surface is. Only the orbits
//! of the eye and of the point that is found take many digits. A search goes in small pieces, so
//! that a frame can have as many of them as it has time for.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{FINEST_FOOTPRINT, field::DeepField, reference::Making, reference::Reference};
use crate::{
    fractal::{DistanceField, camera_ray},
    scene::{Camera, Fractal},
};

/// How near the surface an anchor is, as a part of its depth: so much nearer can the eye come before
/// orbits outlast the anchor's.
const NEARNESS: f64 = 1e-7;
/// Rays through a picture: the first through its middle.
const RAYS: u32 = 9;
/// Steps after which a ray creeps along something.
const MOST_STEPS: u32 = 600;
/// Steps of a piece of a search: a tenth of a millisecond or so.
const STEPS_AT_ONCE: u32 = 16;
/// An older anchor is near enough to march by, in f64, within so many distances of the eye to the
/// surface.
const NEAR_ENOUGH: f64 = 1e6;
/// How exactly an anchor is placed along its ray, as a part of its depth: any point will do.
const GRAIN: f64 = 1e-12;

/// What rays need not know about the surface: parts of the eye's distance to it.
const GRAIN_SEEN: f64 = 1e-4;

/// A search under way.
pub struct Search {
    fractal: Fractal,
    camera: Camera,
    aspect: f64,
    stage: Stage,
}

enum Stage {
    /// The orbit of the eye.
    Eye(Box<Making>),
    /// Rays about an anchor.
    Looking(Looking),
    /// The orbit of what they found.
    Anchor(Box<Making>),
    Found(Arc<Reference>),
}

struct Looking {
    field: DeepField,
    /// Which ray is under way, and how far it is.
    ray: u32,
    steps: u32,
    depth: f64,
    /// The way from the eye to the nearest hit so far.
    nearest: Option<DVec3>,
}

impl Search {
    /// The search for an anchor of what `camera` sees of `fractal` in a picture of this shape, by
    /// the help of an older anchor of the same set. None where the power is no whole number.
    pub fn new(
        fractal: &Fractal,
        camera: &Camera,
        aspect: f64,
        older: Option<&Arc<Reference>>,
    ) -> Option<Self> {
        let helpful = older.filter(|older| older.is_of(fractal)).and_then(|older| {
            let field = DeepField::new(older.clone(), fractal, FINEST_FOOTPRINT);
            let eye = &camera.position - older.anchor();
            (eye.length() < NEAR_ENOUGH * field.distance(eye)).then_some(field)
        });
        let stage = match helpful {
            Some(field) => Stage::Looking(Looking::new(field, camera)),
            None => Stage::Eye(Box::new(Making::new(fractal, camera.position.clone())?)),
        };
        Some(Self { fractal: fractal.clone(), camera: camera.clone(), aspect, stage })
    }

    /// Goes a piece on, for a tenth of a millisecond or so; the anchor's reference once it is found.
    pub fn step(&mut self) -> Option<Arc<Reference>> {
        let next = match &mut self.stage {
            Stage::Eye(making) => {
                if making.step() {
                    return None;
                }
                let eye = Arc::new(making.as_ref().clone().finish());
                Stage::Looking(Looking::new(
                    DeepField::new(eye, &self.fractal, FINEST_FOOTPRINT),
                    &self.camera,
                ))
            }
            Stage::Looking(looking) => {
                if looking.step(&self.camera, self.aspect) {
                    return None;
                }
                // Where there is no surface in view, the eye is as good a point as any.
                let way = looking.nearest.unwrap_or(DVec3::ZERO);
                let anchor = self.camera.position.moved_by(way, GRAIN * way.length());
                match Making::new(&self.fractal, anchor) {
                    Some(making) => Stage::Anchor(Box::new(making)),
                    None => Stage::Found(looking.field.reference().clone()),
                }
            }
            Stage::Anchor(making) => {
                if making.step() {
                    return None;
                }
                Stage::Found(Arc::new(making.as_ref().clone().finish()))
            }
            Stage::Found(reference) => return Some(reference.clone()),
        };
        self.stage = next;
        None
    }

    /// The anchor's reference, whatever is left of the search made at once.
    pub fn finish(mut self) -> Arc<Reference> {
        loop {
            if let Some(reference) = self.step() {
                return reference;
            }
        }
    }
}

impl Looking {
    fn new(field: DeepField, camera: &Camera) -> Self {
        let away = field.distance(&camera.position - &field.origin());
        let field = field.with_grain(GRAIN_SEEN * away);
        Self { field, ray: 0, steps: 0, depth: 0.0, nearest: None }
    }

    /// Goes a few steps on; false after the last ray.
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
            if is_hit || has_left || self.depth > nearest || self.steps >= MOST_STEPS {
                (self.ray, self.steps, self.depth) = (self.ray + 1, 0, 0.0);
                return self.ray < RAYS;
            }
            self.depth += estimate.step.max(0.25 * estimate.distance);
        }
        true
    }
}

/// Where in the picture a ray goes through: the first through its middle, the others on a spiral.
fn ndc(ray: u32) -> DVec2 {
    const GOLDEN_ANGLE_RAD: f64 = 2.399_963_229_728_653;
    let frame = DVec2::from_angle(f64::from(ray) * GOLDEN_ANGLE_RAD);
    0.85 * (f64::from(ray) / f64::from(RAYS - 1)).sqrt() * frame
}
