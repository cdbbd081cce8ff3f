//! The Mandelbulb and its Julia form (thesis 2.5, Algorithm 1).
//!
//! | file | contents |
//! |---|---|
//! | [`parameters`] | the table of parameters, and [`Mandelbulb`], their values as a type |
//! | `power.rs`, `power.wgsl` | zⁿ, without trigonometry where n is a whole number |
//! | [`estimator`] | the distance estimate in f64, its safe step, the bounding sphere |
//! | [`deep`] | perturbation: the set about an anchor, at any depth |
//! | [`variant`] | selects the kernels that draw a view |
//! | [`uniforms`], `types.wgsl` | the kernels' uniforms |
//! | `orbit.wgsl` | follows all orbits: estimates, gradients, colours |
//! | `derivatives.wgsl` | derivatives of an orbit by its point |
//! | `plain.wgsl`, `perturbed.wgsl`, `rotating_frame.wgsl` | an orbit's steps, one file per kernel |
//! | `difference.wgsl`, `series.wgsl` | parts of the perturbed steps |

pub mod deep;
pub mod estimator;
pub mod parameters;
pub mod power;
pub mod uniforms;
pub mod variant;

use std::sync::Arc;

use glam::DVec3;

pub use parameters::{JULIA_CONSTANT, MANDELBULB, Mandelbulb, MandelbulbFormula, POWER, Sine};

use super::{
    DistanceField, Formula, Fractal, KernelFiles, MarchPolicy, Packed, PackedFor, Recurrence,
    ReferenceSteps, table::Field,
};
use crate::precise::PrecisePoint;
use deep::{orbit::recurrence_error, reference::ReferenceBuilder};
use estimator::Estimator;
use parameters::FIELDS;
use variant::{Steps, Variant};

impl Formula for MandelbulbFormula {
    fn id(&self) -> &'static str {
        "mandelbulb"
    }

    fn name(&self) -> &'static str {
        "Mandelbulb"
    }

    fn about(&self) -> &'static str {
        "The Mandelbrot set's step in space: lobes on lobes, of any power from 2 to 16"
    }

    fn fields(&self) -> &'static [Field] {
        FIELDS
    }

    fn max_bailout(&self, fractal: &Fractal) -> f64 {
        Mandelbulb::of(fractal).max_bailout()
    }

    fn march_policy(&self, fractal: &Fractal) -> MarchPolicy {
        Mandelbulb::of(fractal).march_policy()
    }

    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32 {
        deep::iterations_for(&Mandelbulb::of(fractal), footprint)
    }

    fn distance_field(&self, fractal: &Fractal) -> Arc<dyn DistanceField> {
        Arc::new(Estimator::new(&Mandelbulb::of(fractal)))
    }

    fn has_depth(&self, fractal: &Fractal) -> bool {
        Mandelbulb::of(fractal).integer_power().is_some()
    }

    fn deeper(&self) -> Option<&'static str> {
        Some("whole powers zoom deeper")
    }

    fn begin_reference(
        &self,
        fractal: &Fractal,
        anchor: PrecisePoint,
    ) -> Option<Box<dyn ReferenceSteps>> {
        Some(Box::new(ReferenceBuilder::new(&Mandelbulb::of(fractal), anchor)?))
    }

    fn recurrence_error(
        &self,
        fractal: &Fractal,
        point: &PrecisePoint,
        recurrence: Recurrence,
    ) -> Option<DVec3> {
        recurrence_error(&Mandelbulb::of(fractal), point, recurrence)
    }

    fn pack(&self, fractal: &Fractal, view: &PackedFor<'_>) -> Packed {
        uniforms::pack(&Mandelbulb::of(fractal), view)
    }

    fn files(&self, variant: u32) -> KernelFiles {
        Variant::from_number(variant).files()
    }

    fn overrides(&self, variant: u32) -> Vec<(&'static str, f64)> {
        Variant::from_number(variant).overrides()
    }

    fn general(&self, variant: u32) -> Option<u32> {
        Variant::from_number(variant).general().map(Variant::number)
    }

    fn dive_variants(&self, fractal: &Fractal, variant: u32) -> Vec<u32> {
        // Close to the axis one kernel draws all depths.
        if Variant::from_number(variant).steps == Steps::RotatingFrame {
            return Vec::new();
        }
        Variant::of_dive(&Mandelbulb::of(fractal)).map(Variant::number).collect()
    }

    fn is_deep(&self, variant: u32) -> bool {
        Variant::from_number(variant).is_deep()
    }

    fn describe(&self, variant: u32) -> String {
        Variant::from_number(variant).describe()
    }
}
