//! The space about a place, in steps: the radius of its small copy, and its openness at several scales.

use std::sync::Arc;

use glam::DVec3;

use super::vantage::Openings;
use crate::{formula::DistanceField, fractal::spiral::directions, scene::PrecisePoint};

/// Scales at which the space about a place is probed, over the eye's distance.
const PROBED: [f64; 4] = [0.3, 0.05, 5e-3, 1e-4];
/// Least distance of an eye from a small copy's centre, in the copy's radii.
pub const COPY_DISTANCE: f64 = 2.5;
/// Distance of an eye that has arrived at a small copy, in the copy's radii.
pub const ARRIVAL_AT_COPY: f64 = 5.0;
/// Least openness of a place at every probed scale.
const MIN_OPENNESS: f64 = 0.06;
/// Factor between two radii at which a small copy's surroundings are tried.
const RADIUS_STEP: f64 = 0.75;
/// Number of those radii.
const RADII: i32 = 60;
/// Directions that tell whether a radius is free.
const DIRECTIONS: u32 = 24;

/// A probe in progress.
pub struct Probe {
    /// The field about the place.
    pub about: Arc<dyn DistanceField>,
    /// The place.
    pub position: PrecisePoint,
    point: DVec3,
    copy: Option<CopySearch>,
    radius: f64,
    /// Scales that are still to be probed.
    scales: Vec<f64>,
    openings: Option<Openings>,
    openness: f64,
}

/// A search for the radius of a small copy, from the outside inward.
struct CopySearch {
    most: f64,
    index: i32,
    /// True once free space has been found outside of the copy.
    was_free: bool,
}

impl Probe {
    /// A probe about `position`, which an eye sees from `depth` scene units.
    ///
    /// `most_radius` is an upper limit of the radius of the small copy there; none at a cycle.
    pub fn new(
        about: Arc<dyn DistanceField>,
        position: PrecisePoint,
        depth: f64,
        most_radius: Option<f64>,
    ) -> Self {
        let point = about.local(&position);
        let copy = most_radius.map(|most| CopySearch { most, index: 0, was_free: false });
        let finest = 1e3 * about.finest_footprint();
        let scales = PROBED.map(|part| part * depth).into_iter().filter(|it| *it > finest);
        let mut scales: Vec<f64> = scales.collect();
        if scales.is_empty() {
            scales.push(PROBED[0] * depth);
        }
        let (radius, openings, openness) = (0.0, None, 1.0);
        Self { about, position, point, copy, radius, scales, openings, openness }
    }

    /// Measures some distances; returns false once the probe has ended.
    pub fn step(&mut self) -> bool {
        let field = self.about.as_ref();
        if let Some(copy) = &mut self.copy {
            if copy.index == RADII {
                // No copy is there, so the point is no place.
                self.openness = 0.0;
                return false;
            }
            let radius = copy.most * RADIUS_STEP.powi(copy.index);
            copy.index += 1;
            let is_free = is_free(field, self.point, radius);
            if !is_free && copy.was_free {
                self.radius = radius;
                self.scales.retain(|scale| *scale > COPY_DISTANCE * radius);
                if self.scales.is_empty() {
                    self.scales.push(ARRIVAL_AT_COPY * radius);
                }
                self.copy = None;
            } else {
                copy.was_free |= is_free;
            }
            return true;
        }
        let Some(openings) = &mut self.openings else {
            let next = self.scales.pop().filter(|_| self.openness >= MIN_OPENNESS);
            self.openings = next.map(|scale| Openings::new(self.point, scale));
            return self.openings.is_some();
        };
        if !openings.step(field) {
            self.openness = self.openness.min(openings.most_open().1);
            self.openings = None;
        }
        true
    }

    /// The radius of the small copy, and the least openness; none if the space is too narrow.
    pub fn finish(&self) -> Option<(f64, f64)> {
        (self.openness >= MIN_OPENNESS).then_some((self.radius, self.openness))
    }
}

fn is_free(field: &dyn DistanceField, center: DVec3, radius: f64) -> bool {
    directions(DIRECTIONS).all(|toward| field.distance(center + toward * radius) > 0.0)
}
