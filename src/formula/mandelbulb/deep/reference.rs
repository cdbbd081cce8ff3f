//! The reference: an anchor and its orbit.

use std::{any::Any, sync::Arc};

use glam::{DMat3, DVec2, DVec3};

use super::{
    iterations::{FINEST_FOOTPRINT, WHOLE_FOOTPRINT, iterations_for},
    orbit::{ReferencePoint, Tracer},
    series::{SeriesApproximation, SeriesBuilder},
};
use crate::{
    formula::{
        ReferenceOrbit,
        mandelbulb::{estimator::DEEP_SIDEWAYS_MAX, parameters::Mandelbulb, power::TriplexPower},
        recurrence::norm,
    },
    precise::PrecisePoint,
};

/// Greatest distance from the polar axis of an anchor with rotating frames, in scene units.
///
/// Orbits of even powers about such an anchor are followed in frames that rotate with their points'
/// longitudes ([`super::rotating_frame`]).
const ROTATING_FRAME_AXIS_DISTANCE: f64 = 0.03;

/// Most points of a reference, of both orbits together: the capacity of the shaders' uniform buffer.
pub const MAX_REFERENCE_POINTS: usize = 1984;

/// An anchor and its orbit, to which the differences of other orbits are taken.
///
/// The Julia form's reference also holds the orbit of the constant, from which differences restart;
/// the Mandelbulb's differences restart from the anchor's own orbit.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    anchor: PrecisePoint,
    fractal: Mandelbulb,
    power: u32,
    reference_points: Vec<ReferencePoint>,
    own_points: usize,
}

/// A reference under construction. [`Self::step`] takes some microseconds.
#[derive(Clone, Debug)]
pub struct ReferenceBuilder {
    anchor: PrecisePoint,
    fractal: Mandelbulb,
    power: u32,
    own: Tracer,
    critical: Option<Tracer>,
}

impl ReferenceBuilder {
    /// Begins the reference of `anchor`; none if the power is not a whole number.
    pub fn new(fractal: &Mandelbulb, anchor: PrecisePoint) -> Option<Self> {
        let most = iterations_for(fractal, FINEST_FOOTPRINT) as usize + 1;
        let most = most.min(MAX_REFERENCE_POINTS / 2);
        let critical = if fractal.julia { Some(Tracer::critical(fractal, most)?) } else { None };
        Some(Self {
            own: Tracer::of_point(fractal, &anchor, most)?,
            critical,
            power: fractal.integer_power()?,
            anchor,
            fractal: fractal.clone(),
        })
    }

    /// Computes the next point; returns false once all points are computed.
    pub fn step(&mut self) -> bool {
        self.own.step() || self.critical.as_mut().is_some_and(Tracer::step)
    }

    /// Computes the remaining points and returns the reference.
    pub fn finish(self) -> Reference {
        let mut reference_points = self.own.finish();
        let own_points = reference_points.len();
        if let Some(critical) = self.critical {
            reference_points.extend(critical.finish());
        }
        let Self { anchor, fractal, power, .. } = self;
        Reference { anchor, fractal, power, reference_points, own_points }
    }
}

impl Reference {
    /// The reference of `anchor`; none if the power is not a whole number.
    pub fn new(fractal: &Mandelbulb, anchor: PrecisePoint) -> Option<Self> {
        Some(ReferenceBuilder::new(fractal, anchor)?.finish())
    }

    /// The anchor.
    pub fn anchor(&self) -> &PrecisePoint {
        &self.anchor
    }

    /// The anchor's orbit, followed by the constant's orbit for the Julia form.
    pub fn points(&self) -> &[ReferencePoint] {
        &self.reference_points
    }

    /// The power.
    pub fn power(&self) -> u32 {
        self.power
    }

    /// Whether the reference is of the Julia form.
    pub fn is_julia(&self) -> bool {
        self.fractal.julia
    }

    /// Number of points of the anchor's own orbit.
    pub fn own_points(&self) -> usize {
        self.own_points
    }

    /// Index of the point from which differences restart.
    pub fn restart(&self) -> usize {
        if self.fractal.julia { self.own_points } else { 0 }
    }

    /// The constant that each step of the reference orbit adds.
    pub fn constant(&self) -> DVec3 {
        self.reference_points[self.restart()].z
    }

    /// Whether orbits about the anchor are followed in rotating frames.
    ///
    /// The Julia form's constant rotates in such a frame by as much as orbits would rotate in a fixed frame,
    /// so the constant must be near the axis too.
    pub fn rotates(&self) -> bool {
        let constant = &self.reference_points[self.restart()];
        self.power.is_multiple_of(2)
            && self.reference_points[0].rho.max(constant.rho) < ROTATING_FRAME_AXIS_DISTANCE
    }

    /// Whether the reference belongs to `fractal`; iterations are not compared.
    pub fn is_of(&self, fractal: &Mandelbulb) -> bool {
        let same = Mandelbulb { iterations: self.fractal.iterations, ..fractal.clone() };
        same == self.fractal
    }

    /// For each radius, the series approximation for points within that radius of the anchor.
    ///
    /// Radii are in units of `scale`. In rotating frames the addend of orbits close to the axis is no smooth
    /// function of the point, so the approximations replace no steps.
    pub fn series(&self, scale: f64, radii: &[f64]) -> Vec<SeriesApproximation> {
        self.series_builder(scale).within(radii)
    }

    /// A series approximation of no steps.
    pub fn empty_series(&self, scale: f64) -> SeriesApproximation {
        self.series_builder(scale).start()
    }

    /// dr along the anchor's orbit from its start, at no more than `count` points.
    ///
    /// In units of one over the scale.
    pub fn derivatives(&self, scale: f64, count: usize) -> Vec<f64> {
        let power = TriplexPower::new(&self.fractal);
        let added = if self.fractal.julia { 0.0 } else { scale };
        let mut dr = scale;
        let reference_points = &self.reference_points[..count.min(self.own_points)];
        let step = |reference_point: &ReferencePoint| {
            let here = dr;
            dr = power.growth(reference_point.z.length()) * dr + added;
            here
        };
        reference_points.iter().map(step).collect()
    }

    /// The Jacobian of the anchor's orbit where the orbits of points one `scale` away part from it.
    ///
    /// In units of one over the scale. The steps after a series may stretch another direction most than the series does: in one
    /// view, a step beside the origin stretches one at right angles to it thirty times as much as dr says.
    pub fn parting_jacobian(&self, scale: f64) -> DMat3 {
        let power = TriplexPower::new(&self.fractal);
        let start = DMat3::from_diagonal(DVec3::splat(scale));
        let added = if self.fractal.julia { DMat3::ZERO } else { start };
        let mut jacobian = start;
        for point in &self.reference_points[..self.own_points] {
            if norm(&jacobian) >= 1.0 || point.z.truncate() == DVec2::ZERO {
                break;
            }
            jacobian = power.jacobian(point.z, DEEP_SIDEWAYS_MAX) * jacobian + added;
        }
        jacobian
    }

    /// Iterations of a view of `fractal` whose pixels have radius `footprint` at the surface.
    ///
    /// [`iterations_for`] is enough for 99 of 100 points; but all points of a view share most steps with the anchor. If
    /// the anchor's dr takes more steps to grow from 1 / [`WHOLE_FOOTPRINT`] to 1 / `footprint`, those are added. If it takes
    /// more steps than the scene's own to grow to 1 / `WHOLE_FOOTPRINT`, that many count as the scene's own.
    pub fn iterations_for(&self, fractal: &Mandelbulb, footprint: f64) -> u32 {
        let derivatives = self.derivatives(1.0, self.own_points);
        let finest = footprint.clamp(0.1 * FINEST_FOOTPRINT, WHOLE_FOOTPRINT);
        let steps_to = |footprint: f64| {
            let is_enough = |dr: &f64| dr * footprint >= 1.0;
            derivatives.iter().position(is_enough)
        };
        // An orbit that never gets there says nothing of how many steps others take.
        let Some(steps_to_whole) = steps_to(WHOLE_FOOTPRINT) else {
            return iterations_for(fractal, footprint);
        };
        let more = (steps_to(finest).unwrap_or(derivatives.len()) - steps_to_whole) as u32;
        let iterations = fractal.iterations.max(steps_to_whole as u32);
        let slower = Mandelbulb { iterations, ..fractal.clone() };
        iterations_for(&slower, footprint).max(iterations + more)
    }

    fn series_builder(&self, scale: f64) -> SeriesBuilder<'_> {
        let reference_points = if self.rotates() { 1 } else { self.own_points };
        SeriesBuilder {
            power: TriplexPower::new(&self.fractal),
            whole_power: self.power,
            sine_sign: self.sine_sign(),
            is_mandelbulb: !self.fractal.julia,
            reference_points: &self.reference_points[..reference_points],
            scale,
        }
    }

    /// Sign of the latitude's sine: 1 or −1.
    pub(super) fn sine_sign(&self) -> f64 {
        self.fractal.sine.sign()
    }

    /// Whether another point of the same orbit follows the point at `index`.
    pub(super) fn goes_on(&self, index: usize) -> bool {
        index + 1 != self.own_points && index + 1 < self.reference_points.len()
    }
}

/// `reference` as a Mandelbulb's [`Reference`]; none if the orbit is of another formula.
pub fn reference_of(reference: &Arc<dyn ReferenceOrbit>) -> Option<&Reference> {
    let any: &dyn Any = reference.as_ref();
    any.downcast_ref()
}
