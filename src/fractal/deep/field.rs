//! The distance field about an anchor, in f64.

use std::sync::Arc;

use glam::DVec3;

use super::{
    FINEST_FOOTPRINT, difference, iterations_for,
    reference::Reference,
    spread::{Spread, TurningSpread},
    turn::Turn,
};
use crate::{
    fractal::{DistanceField, Estimator, Reach, estimator::Orbit, power::TriplexPower},
    scene::{Fractal, PrecisePoint},
};

/// A difference is followed by itself while it is smaller than this part of the place; a larger one
/// f32 knows well enough from the place itself. With a third of it normals from samples a footprint
/// apart turn by 0.07 degrees in the mean.
pub const CLOSE: f64 = 0.01;

/// The set about an anchor. Points are offsets from it, in scene units.
#[derive(Clone, Debug)]
pub struct DeepField {
    reference: Arc<Reference>,
    estimator: Estimator,
    center: DVec3,
    grain: f64,
}

impl DeepField {
    /// The set about `reference`'s anchor, with the iterations that pixels of this radius at the
    /// surface need, in scene units.
    pub fn new(reference: Arc<Reference>, fractal: &Fractal, footprint: f64) -> Self {
        let iterations = iterations_for(fractal, footprint);
        let fractal = Fractal { iterations, ..fractal.clone() };
        let center = -reference.anchor().to_dvec3();
        Self { estimator: Estimator::new(&fractal), center, reference, grain: footprint }
    }

    /// Its anchor and orbit.
    pub fn reference(&self) -> &Arc<Reference> {
        &self.reference
    }

    /// The same for rays that need not know what is finer than `grain`, in scene units.
    pub fn with_grain(self, grain: f64) -> Self {
        Self { grain: grain.max(FINEST_FOOTPRINT), ..self }
    }
}

impl DistanceField for DeepField {
    fn distance(&self, point: DVec3) -> f64 {
        self.reach(point).distance
    }

    fn reach(&self, point: DVec3) -> Reach {
        self.estimator.reach_along(DeepOrbit::new(self, point))
    }

    fn has_dips(&self) -> bool {
        self.estimator.has_dips()
    }

    fn bounding_radius(&self) -> f64 {
        self.estimator.bounding_radius()
    }

    fn origin(&self) -> PrecisePoint {
        self.reference.anchor().clone()
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
    /// How far the constant is from the reference's.
    offset: DVec3,
    /// Which place it is the difference to.
    place: usize,
    difference: DVec3,
    frame: Frame,
}

/// What an orbit is followed in, and how it moves with its point.
enum Frame {
    Fixed(Spread),
    /// It turns with the point's longitude; so far it has been followed for so many steps.
    Turning(Turn, TurningSpread, u32),
}

impl<'a> DeepOrbit<'a> {
    /// Of the point that is `point` away from the anchor.
    fn new(field: &'a DeepField, point: DVec3) -> Self {
        let reference = field.reference.as_ref();
        let is_julia = reference.is_julia();
        let offset = if is_julia { DVec3::ZERO } else { point };
        let constant_derivative = if is_julia { 0.0 } else { 1.0 };
        let (frame, difference) = if reference.turns() {
            let (turn, difference) = Turn::of(reference.first(), point, reference.power());
            let constant = reference.constant() + offset;
            let spread =
                TurningSpread::new(constant, constant_derivative, turn.rotor(), field.grain);
            (Frame::Turning(turn, spread, 0), difference)
        } else {
            (Frame::Fixed(Spread::new(constant_derivative)), point)
        };
        let sine_sign = reference.sine_sign();
        Self { reference, sine_sign, offset, place: 0, difference, frame }
    }

    /// The next power's difference to the place's.
    fn raised(&self) -> DVec3 {
        let begins_turned = matches!(self.frame, Frame::Turning(.., 0));
        let raised =
            if begins_turned { difference::raised_on_meridian } else { difference::raised };
        let place = &self.reference.places()[self.place];
        raised(place, self.difference, self.reference.power(), self.sine_sign)
    }
}

impl Orbit for DeepOrbit<'_> {
    fn z(&self) -> DVec3 {
        self.reference.places()[self.place].z + self.difference
    }

    fn step(&mut self, power: &TriplexPower) {
        let z = self.z();
        let is_close = self.difference.length() < CLOSE * z.length();
        let goes_on = is_close && self.reference.goes_on(self.place);
        let raised = if goes_on { self.raised() } else { power.apply(z) };
        let added = match &mut self.frame {
            Frame::Fixed(spread) => {
                spread.step(power, z);
                self.offset
            }
            Frame::Turning(turn, spread, steps) => {
                *turn = turn.next();
                *steps += 1;
                spread.step(power, z, turn.rotor());
                turn.added(self.reference.constant(), self.offset)
            }
        };
        self.difference = raised + added;
        self.place = if goes_on { self.place + 1 } else { self.reference.restart() };
    }

    fn norm(&self) -> f64 {
        match &self.frame {
            Frame::Fixed(spread) => spread.norm(),
            Frame::Turning(_, spread, _) => spread.norm(),
        }
    }
}
