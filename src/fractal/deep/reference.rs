//! An anchor with its orbit, and the distance field about it.

use std::sync::Arc;

use glam::DVec3;

use super::{
    FINEST_FOOTPRINT, difference, iterations_for,
    orbit::{Place, Tracer},
    skip::{Skip, Skipping},
};
use crate::{
    fractal::{DistanceField, Estimator, Reach, estimator::Orbit, power::TriplexPower},
    scene::{Fractal, PrecisePoint},
};

/// A difference is followed by itself while it is smaller than this part of the place; a larger one
/// f32 knows well enough from the place itself. With a third of it normals from samples a footprint
/// apart turn by 0.07 degrees in the mean.
pub const CLOSE: f64 = 0.01;

/// Most places of a reference, of both its orbits together.
pub const MOST_PLACES: usize = 2048;

/// An anchor's orbit. The Julia form's has that of its constant behind it, which differences start
/// anew from; those of the Mandelbulb start anew from the anchor's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    anchor: PrecisePoint,
    fractal: Fractal,
    power: u32,
    places: Vec<Place>,
    own_places: usize,
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
        let most = most.min(MOST_PLACES / 2);
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
        let mut places = self.own.finish();
        let own_places = places.len();
        if let Some(critical) = self.critical {
            places.extend(critical.finish());
        }
        let Self { anchor, fractal, power, .. } = self;
        Reference { anchor, fractal, power, places, own_places }
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
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// How many of the places are the anchor's.
    pub fn own_places(&self) -> usize {
        self.own_places
    }

    /// Where differences start anew: a place's index.
    pub fn restart(&self) -> usize {
        if self.fractal.julia { self.own_places } else { 0 }
    }

    /// Whether it is one of this set, however many iterations that has.
    pub fn is_of(&self, fractal: &Fractal) -> bool {
        let same = Fractal { iterations: self.fractal.iterations, ..fractal.clone() };
        same == self.fractal
    }

    /// For each radius, what all orbits can skip whose points are as near to the anchor, in units of
    /// `scale`.
    pub fn skips(&self, scale: f64, radii: &[f64]) -> Vec<Skip> {
        Skipping {
            power: TriplexPower::new(&self.fractal),
            whole_power: self.power,
            sine_sign: self.sine_sign(),
            is_mandelbulb: !self.fractal.julia,
            places: &self.places[..self.own_places],
            scale,
        }
        .within(radii)
    }

    fn sine_sign(&self) -> f64 {
        self.fractal.variant.sine_sign()
    }

    /// Whether the reference has another place after this one.
    fn goes_on(&self, place: usize) -> bool {
        place + 1 != self.own_places && place + 1 < self.places.len()
    }
}

/// The set about an anchor. Points are offsets from it, in scene units.
#[derive(Clone, Debug)]
pub struct DeepField {
    reference: Arc<Reference>,
    estimator: Estimator,
    center: DVec3,
}

impl DeepField {
    /// The set about `reference`'s anchor, with the iterations that pixels of this radius at the
    /// surface need, in scene units.
    pub fn new(reference: Arc<Reference>, fractal: &Fractal, footprint: f64) -> Self {
        let iterations = iterations_for(fractal, footprint);
        let fractal = Fractal { iterations, ..fractal.clone() };
        let center = -reference.anchor.to_dvec3();
        Self { estimator: Estimator::new(&fractal), center, reference }
    }

    /// Its anchor and orbit.
    pub fn reference(&self) -> &Arc<Reference> {
        &self.reference
    }
}

impl DistanceField for DeepField {
    fn distance(&self, point: DVec3) -> f64 {
        self.reach(point).distance
    }

    fn reach(&self, point: DVec3) -> Reach {
        self.estimator.reach_along(DeepOrbit {
            reference: &self.reference,
            sine_sign: self.reference.sine_sign(),
            added: if self.reference.fractal.julia { DVec3::ZERO } else { point },
            place: 0,
            difference: point,
        })
    }

    fn has_dips(&self) -> bool {
        self.estimator.has_dips()
    }

    fn bounding_radius(&self) -> f64 {
        self.estimator.bounding_radius()
    }

    fn origin(&self) -> PrecisePoint {
        self.reference.anchor.clone()
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn finest_footprint(&self) -> f64 {
        FINEST_FOOTPRINT
    }
}

/// A point's orbit, by its difference to the reference.
struct DeepOrbit<'a> {
    reference: &'a Reference,
    sine_sign: f64,
    /// What each step adds to the difference.
    added: DVec3,
    /// Which place it is the difference to.
    place: usize,
    difference: DVec3,
}

impl Orbit for DeepOrbit<'_> {
    fn z(&self) -> DVec3 {
        self.reference.places[self.place].z + self.difference
    }

    fn step(&mut self, raised: DVec3) {
        let z = self.z();
        let is_close = self.difference.length() < CLOSE * z.length();
        if is_close && self.reference.goes_on(self.place) {
            let place = &self.reference.places[self.place];
            self.difference =
                difference::raised(place, self.difference, self.reference.power, self.sine_sign)
                    + self.added;
            self.place += 1;
        } else {
            self.difference = raised + self.added;
            self.place = self.reference.restart();
        }
    }
}
