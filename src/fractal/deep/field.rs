//! The distance field about an anchor, in f64.

use std::sync::Arc;

use glam::DVec3;

use super::{
    FINEST_FOOTPRINT, difference, iterations_for,
    jacobian::{OrbitJacobian, RotatingJacobian},
    reference::Reference,
    rotating_frame::RotatingFrame,
};
use crate::{
    fractal::{DistanceField, Estimate, Estimator, estimator::Orbit, power::TriplexPower},
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
        self.estimate(point).distance
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        self.estimator.estimate_along(DeepOrbit::new(self, point))
    }

    fn needs_hit_check(&self) -> bool {
        self.estimator.needs_hit_check()
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
    reference_point: usize,
    difference: DVec3,
    frame: Frame,
}

/// What an orbit is followed in, and how it moves with its point.
enum Frame {
    Fixed(OrbitJacobian),
    /// It turns with the orbit's longitude.
    Rotating(RotatingFrame, RotatingJacobian),
}

impl<'a> DeepOrbit<'a> {
    /// Of the point that is `point` away from the anchor.
    fn new(field: &'a DeepField, point: DVec3) -> Self {
        let reference = field.reference.as_ref();
        let is_julia = reference.is_julia();
        let offset = if is_julia { DVec3::ZERO } else { point };
        let constant_derivative = if is_julia { 0.0 } else { 1.0 };
        let (frame, difference) = if reference.rotates() {
            let mut frame = RotatingFrame::none(reference.power());
            let (difference, _) = frame.settle(&reference.points()[0], point);
            let constant = reference.constant() + offset;
            let jacobian =
                RotatingJacobian::new(constant, constant_derivative, frame.back(), field.grain);
            (Frame::Rotating(frame, jacobian), difference)
        } else {
            (Frame::Fixed(OrbitJacobian::new(constant_derivative)), point)
        };
        let sine_sign = reference.sine_sign();
        Self { reference, sine_sign, offset, reference_point: 0, difference, frame }
    }
}

impl Orbit for DeepOrbit<'_> {
    fn z(&self) -> DVec3 {
        self.reference.points()[self.reference_point].z + self.difference
    }

    fn step(&mut self, power: &TriplexPower) {
        let z = self.z();
        let Self { reference, sine_sign, offset, .. } = *self;
        let reference_point = &reference.points()[self.reference_point];
        let is_close = self.difference.length() < CLOSE * z.length();
        let goes_on = is_close && reference.goes_on(self.reference_point);
        let raised = match self.frame {
            _ if !goes_on => power.apply(z),
            Frame::Fixed(_) => {
                difference::raised(reference_point, self.difference, reference.power(), sine_sign)
            }
            Frame::Rotating(..) => difference::raised_on_meridian(
                reference_point,
                self.difference,
                reference.power(),
                sine_sign,
            ),
        };
        self.reference_point = if goes_on { self.reference_point + 1 } else { reference.restart() };
        self.difference = match &mut self.frame {
            Frame::Fixed(jacobian) => {
                jacobian.step(power, z);
                raised + offset
            }
            Frame::Rotating(frame, jacobian) => {
                *frame = frame.raised();
                jacobian.step(power, z, frame.back());
                let difference = raised + frame.added(reference.constant(), offset);
                let (difference, rotor) =
                    frame.settle(&reference.points()[self.reference_point], difference);
                jacobian.settle(rotor);
                difference
            }
        };
    }

    fn norm(&self) -> f64 {
        match &self.frame {
            Frame::Fixed(jacobian) => jacobian.norm(),
            Frame::Rotating(_, jacobian) => jacobian.norm(),
        }
    }
}
