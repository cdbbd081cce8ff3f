//! The distance field about an anchor, in f64.

use std::sync::Arc;

use glam::DVec3;

use super::{
    FINEST_FOOTPRINT, difference,
    jacobian::{OrbitJacobian, RotatingJacobian},
    reference::{Reference, ReferenceBuilder},
    rotating_frame::RotatingFrame,
};
use crate::{
    formula::{
        DistanceField, Estimate, Formula, Fractal, OrbitPosition, ReferenceOrbit, ReferenceSteps,
        mandelbulb::{
            MANDELBULB, Mandelbulb,
            estimator::{Estimator, NormedOrbit, Orbit},
            power::TriplexPower,
        },
    },
    precise::PrecisePoint,
};

/// Perturbed steps follow a difference below this part of |z|.
///
/// For a larger difference, f32 stores z itself exactly enough. With a third of this value, normals from
/// samples a footprint apart turn by 0.07 degrees on average.
pub const CLOSE: f64 = 0.01;

/// The set's distance field about an anchor. Points are offsets from the anchor, in scene units.
#[derive(Clone, Debug)]
pub struct DeepField {
    reference: Arc<Reference>,
    estimator: Estimator,
    center: DVec3,
    grain: f64,
}

impl DeepField {
    /// The field about `reference`'s anchor, with iterations for pixels of radius `footprint`.
    ///
    /// `footprint` is the radius at the surface, in scene units.
    pub fn new(reference: Arc<Reference>, fractal: &Mandelbulb, footprint: f64) -> Self {
        let iterations = reference.iterations_for(fractal, footprint);
        let fractal = Mandelbulb { iterations, ..fractal.clone() };
        let center = -reference.anchor().to_dvec3();
        Self { estimator: Estimator::new(&fractal), center, reference, grain: footprint }
    }

    /// The reference: the anchor and its orbit.
    pub fn reference(&self) -> &Arc<Reference> {
        &self.reference
    }

    /// The field for rays that may ignore detail finer than `grain`, in scene units.
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

    fn orbit(&self, point: DVec3, length: usize) -> Vec<OrbitPosition> {
        // In a rotating frame, positions lack their longitudes.
        if self.reference.rotates() {
            return Vec::new();
        }
        self.estimator.positions(DeepOrbit::new(self, point), length)
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

/// A point's orbit, followed by its difference to the reference orbit.
struct DeepOrbit<'a> {
    reference: &'a Reference,
    sine_sign: f64,
    /// Offset of the orbit's constant from the reference's constant.
    offset: DVec3,
    /// Index of the current reference point.
    index: usize,
    difference: DVec3,
    frame: Frame,
}

/// The frame in which an orbit is followed, with the orbit's Jacobian.
enum Frame {
    Fixed(OrbitJacobian),
    /// The frame rotates with the orbit's longitude.
    Rotating(RotatingFrame, RotatingJacobian),
}

impl<'a> DeepOrbit<'a> {
    /// The orbit of the point at the anchor + `point`.
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
        Self { reference, sine_sign, offset, index: 0, difference, frame }
    }
}

impl Orbit for DeepOrbit<'_> {
    fn z(&self) -> DVec3 {
        self.reference.points()[self.index].z + self.difference
    }

    fn step(&mut self, power: &TriplexPower) {
        let z = self.z();
        let Self { reference, sine_sign, offset, .. } = *self;
        let reference_point = &reference.points()[self.index];
        let is_close = self.difference.length() < CLOSE * z.length();
        let goes_on = is_close && reference.goes_on(self.index);
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
        self.index = if goes_on { self.index + 1 } else { reference.restart() };
        self.difference = match &mut self.frame {
            Frame::Fixed(jacobian) => {
                jacobian.step(power, z);
                raised + offset
            }
            Frame::Rotating(frame, jacobian) => {
                *frame = frame.raised();
                jacobian.step(power, z, frame.back());
                let difference = raised + frame.added(reference.constant(), offset);
                let (difference, rotor) = frame.settle(&reference.points()[self.index], difference);
                jacobian.settle(rotor);
                difference
            }
        };
    }
}

impl NormedOrbit for DeepOrbit<'_> {
    fn norm(&self) -> f64 {
        match &self.frame {
            Frame::Fixed(jacobian) => jacobian.norm(),
            Frame::Rotating(_, jacobian) => jacobian.norm(),
        }
    }
}

impl ReferenceOrbit for Reference {
    fn anchor(&self) -> &PrecisePoint {
        Reference::anchor(self)
    }

    fn is_of(&self, fractal: &Fractal) -> bool {
        fractal.formula().id() == MANDELBULB.id() && self.is_of(&Mandelbulb::of(fractal))
    }

    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32 {
        Reference::iterations_for(self, &Mandelbulb::of(fractal), footprint)
    }

    fn distance_field(
        self: Arc<Self>,
        fractal: &Fractal,
        footprint: f64,
        grain: f64,
    ) -> Arc<dyn DistanceField> {
        let field = DeepField::new(self, &Mandelbulb::of(fractal), footprint);
        Arc::new(field.with_grain(grain))
    }
}

impl ReferenceSteps for ReferenceBuilder {
    fn step(&mut self) -> bool {
        ReferenceBuilder::step(self)
    }

    fn finish(self: Box<Self>) -> Arc<dyn ReferenceOrbit> {
        Arc::new(ReferenceBuilder::finish(*self))
    }
}
