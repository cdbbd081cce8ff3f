//! An anchor with its orbit.

use glam::DVec3;

use super::{
    FINEST_FOOTPRINT, iterations_for,
    orbit::{ReferencePoint, Tracer},
    series::{SeriesApproximation, SeriesBuilder},
};
use crate::{
    fractal::power::TriplexPower,
    scene::{Fractal, PrecisePoint},
};

/// Orbits of even powers about an anchor that is as near to the polar axis as this, in scene units,
/// are followed in frames that turn with their points' longitudes ([`super::rotating_frame`]).
const HARD_BY_AXIS: f64 = 0.03;

/// Most places of a reference, of both its orbits together: what the shaders' uniform buffer has room for.
pub const MOST_REFERENCE_POINTS: usize = 1984;

/// An anchor's orbit. The Julia form's has that of its constant behind it, which differences start
/// anew from; those of the Mandelbulb start anew from the anchor's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    anchor: PrecisePoint,
    fractal: Fractal,
    power: u32,
    reference_points: Vec<ReferencePoint>,
    own_points: usize,
}

/// A reference on its way: [`Self::step`] costs some microseconds.
#[derive(Clone, Debug)]
pub struct Making {
    anchor: PrecisePoint,
    fractal: Fractal,
    power: u32,
    own: Tracer,
    critical: Option<Tracer>,
}

impl Making {
    /// The reference of `anchor`; none where the power is no whole number.
    pub fn new(fractal: &Fractal, anchor: PrecisePoint) -> Option<Self> {
        let most = iterations_for(fractal, FINEST_FOOTPRINT) as usize + 1;
        let most = most.min(MOST_REFERENCE_POINTS / 2);
        let critical = if fractal.julia { Some(Tracer::critical(fractal, most)?) } else { None };
        Some(Self {
            own: Tracer::of_point(fractal, &anchor, most)?,
            critical,
            power: fractal.integer_power()?,
            anchor,
            fractal: fractal.clone(),
        })
    }

    /// Goes one place on; false where all are there.
    pub fn step(&mut self) -> bool {
        self.own.step() || self.critical.as_mut().is_some_and(Tracer::step)
    }

    /// The reference, whatever is left of it made at once.
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
    /// The reference of `anchor`; none where the power is no whole number.
    pub fn new(fractal: &Fractal, anchor: PrecisePoint) -> Option<Self> {
        Some(Making::new(fractal, anchor)?.finish())
    }

    /// The anchor.
    pub fn anchor(&self) -> &PrecisePoint {
        &self.anchor
    }

    /// The anchor's orbit, and behind it, for the Julia form, that of the constant.
    pub fn points(&self) -> &[ReferencePoint] {
        &self.reference_points
    }

    /// The power.
    pub fn power(&self) -> u32 {
        self.power
    }

    /// Whether it is of the Julia form.
    pub fn is_julia(&self) -> bool {
        self.fractal.julia
    }

    /// How many of the places are the anchor's.
    pub fn own_points(&self) -> usize {
        self.own_points
    }

    /// Where differences start anew: a place's index.
    pub fn restart(&self) -> usize {
        if self.fractal.julia { self.own_points } else { 0 }
    }

    /// What the steps of its orbit add.
    pub fn constant(&self) -> DVec3 {
        self.reference_points[self.restart()].z
    }

    /// Whether orbits about it are followed in frames that turn with their points' longitudes. The
    /// Julia form's constant turns in such a frame by as much as its orbits would without; only one
    /// that is near the axis itself does not matter.
    pub fn rotates(&self) -> bool {
        let constant = &self.reference_points[self.restart()];
        self.power.is_multiple_of(2)
            && self.reference_points[0].rho.max(constant.rho) < HARD_BY_AXIS
    }

    /// Whether it is one of this set, however many iterations that has.
    pub fn is_of(&self, fractal: &Fractal) -> bool {
        let same = Fractal { iterations: self.fractal.iterations, ..fractal.clone() };
        same == self.fractal
    }

    /// For each radius, what all orbits can skip whose points are as near to the anchor, in units of
    /// `scale`. Where frames turn, what is added to orbits hard by the axis is no smooth function of
    /// their point: nothing is skipped.
    pub fn series(&self, scale: f64, radii: &[f64]) -> Vec<SeriesApproximation> {
        self.series_builder(scale).within(radii)
    }

    /// An approximation of no steps.
    pub fn empty_series(&self, scale: f64) -> SeriesApproximation {
        self.series_builder(scale).start()
    }

    /// dr along the anchor's orbit, from its start on, at so many of its places at most; in units of one
    /// over the scale.
    pub fn derivatives(&self, scale: f64, reference_points: usize) -> Vec<f64> {
        let power = TriplexPower::new(&self.fractal);
        let added = if self.fractal.julia { 0.0 } else { scale };
        let mut dr = scale;
        let reference_points = &self.reference_points[..reference_points.min(self.own_points)];
        let step = |reference_point: &ReferencePoint| {
            let here = dr;
            dr = power.growth(reference_point.z.length()) * dr + added;
            here
        };
        reference_points.iter().map(step).collect()
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

    /// What the sine of the latitude is multiplied by.
    pub(super) fn sine_sign(&self) -> f64 {
        self.fractal.variant.sine_sign()
    }

    /// Whether the reference has another place after this one.
    pub(super) fn goes_on(&self, reference_point: usize) -> bool {
        reference_point + 1 != self.own_points && reference_point + 1 < self.reference_points.len()
    }
}
