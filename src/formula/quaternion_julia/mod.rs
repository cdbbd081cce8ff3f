//! The quaternion Julia set: q ← q² + c, cut by a three-dimensional plane.
//!
//! Sources: A. Norton, "Generation and display of geometric fractals in 3-D", 1982; J. C. Hart, D. J. Sandin
//! and L. H. Kauffman, "Ray tracing deterministic 3-D fractals", 1989, for the distance estimate.
//!
//! The orbit of a point (x, y, z) starts at the quaternion x + yi + zj + wk, with w the slice. A step
//! stretches no direction by more than 2|q|: of the derivative v ↦ qv + vq two singular values are 2|q|,
//! two are 2|Re q|. So dr ← 2|q|·dr bounds the Jacobian's norm, and rays step by the whole estimate
//! `½ · ln r · r / dr`.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4Swizzles};

use super::{
    DistanceField, Estimate, Formula, FormulaRef, Fractal, Kernel, KernelFiles, Packed, PackedFor,
    bounds::slowest_escape,
    march::PLAIN_FOOTPRINT,
    param::params,
    table::{Field, Kind, Value},
};
use crate::gpu::{
    host_shared::{HostShared, host_shared},
    shader::File,
};

params! {
    /// The set's own numbers.
    PARAMS;
    SLICE = "fractal.slice", "Slice", None, -1.5, 1.5, default 0.0, Linear by 0.01,
        "Where the four-dimensional set is cut: the fourth coordinate of all points of the picture.";
    CONSTANT = "fractal.constant[]", "Constant", None, -2.0, 2.0, default 0.0, Linear by 0.01,
        "One part of the quaternion c that every step adds. Small changes reshape the whole set.";
}

/// In document order, which [`QuaternionJulia::of`] follows.
const FIELDS: &[Field] = &[
    Field {
        name: "slice",
        kind: Kind::Number { param: &SLICE, quick: &[] },
        only_with: None,
    },
    Field {
        name: "constant",
        kind: Kind::Vector {
            param: &CONSTANT,
            labels: &["Constant, real", "Constant, i", "Constant, j", "Constant, k"],
            default: &[-0.125, -0.256, 0.847, 0.0895],
        },
        only_with: None,
    },
];

host_shared! {
    /// Name, size in bytes and fields of every struct here.
    HOST_SHARED;
    /// The set as in `types.wgsl`, where its name is `Fractal`.
    Uniforms {
        /// Real part first.
        constant: [f32; 4],
        /// Fourth coordinate of the points that are drawn.
        slice: f32,
        /// Squared escape radius.
        limit: f32,
        /// Binary logarithm of the bailout.
        log2_bailout: f32,
        /// Most orbit steps.
        iterations: u32,
        /// Longest step of a ray.
        max_step: f32,
    }
}

/// Finest footprint that gets iterations of its own, in scene units: an eye on the surface has none.
const FINEST_FOOTPRINT: f64 = 0.1 * PLAIN_FOOTPRINT;
/// Least footprint that needs no more than the scene's own iterations, in scene units.
const WHOLE_FOOTPRINT: f64 = 1e-3;
/// Orbit steps per halving of the footprint: enough nearly everywhere to separate neighbouring points.
const STEPS_PER_HALVING: f64 = 1.5;
/// Longest step of a ray, in bounding radii.
///
/// An orbit that passes the origin makes dr vanish, and the estimate grows without bound.
const MAX_STEP: f64 = 0.05;
/// Keeps the estimate finite if dr vanishes.
const MIN_DERIVATIVE: f64 = 1e-30;

/// The set in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuaternionJulia {
    constant: DVec4,
    slice: f64,
    iterations: u32,
    bailout: f64,
    bounding_radius: f64,
}

impl QuaternionJulia {
    fn of(fractal: &Fractal) -> Self {
        let [Value::Number(slice), Value::Vector(constant)] = fractal.values() else {
            panic!("a quaternion Julia set has other values than a {:?}", fractal.formula());
        };
        let constant = DVec4::from_array(std::array::from_fn(|i| constant[i]));
        let (iterations, bailout) = (fractal.iterations, fractal.bailout);
        let bounding_radius = slowest_escape(2.0, Some(constant.length()), iterations, bailout);
        Self { constant, slice: *slice, iterations, bailout, bounding_radius }
    }

    fn max_step(&self) -> f64 {
        MAX_STEP * self.bounding_radius
    }
}

/// q²: the real part is `q.x`.
fn squared(q: DVec4) -> DVec4 {
    let imaginary = q.yzw();
    let twice = 2.0 * q.x * imaginary;
    DVec4::new(q.x * q.x - imaginary.length_squared(), twice.x, twice.y, twice.z)
}

impl DistanceField for QuaternionJulia {
    fn distance(&self, point: DVec3) -> f64 {
        let mut q = point.extend(self.slice);
        let (mut r, mut dr) = (q.length(), 1.0);
        for _ in 0..self.iterations {
            if r > self.bailout {
                break;
            }
            dr *= 2.0 * r;
            q = squared(q) + self.constant;
            r = q.length();
        }
        if r <= 1.0 { 0.0 } else { 0.5 * r.ln() * r / dr.max(MIN_DERIVATIVE) }
    }

    fn estimate(&self, point: DVec3) -> Estimate {
        let distance = self.distance(point);
        Estimate { distance, step: distance.min(self.max_step()) }
    }

    fn bounding_radius(&self) -> f64 {
        self.bounding_radius
    }
}

/// The type that implements [`Formula`].
#[derive(Debug)]
pub struct QuaternionJuliaFormula;

/// The instance that `formulas!` lists.
pub static QUATERNION_JULIA: QuaternionJuliaFormula = QuaternionJuliaFormula;

impl Formula for QuaternionJuliaFormula {
    fn id(&self) -> &'static str {
        "quaternion_julia"
    }

    fn name(&self) -> &'static str {
        "Quaternion Julia"
    }

    fn about(&self) -> &'static str {
        "A Julia set of four dimensions, cut so that it fits in three: smooth folds and whorls"
    }

    fn fields(&self) -> &'static [Field] {
        FIELDS
    }

    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32 {
        let halvings = (WHOLE_FOOTPRINT / footprint.max(FINEST_FOOTPRINT)).max(1.0).log2();
        fractal.iterations + (STEPS_PER_HALVING * halvings).ceil() as u32
    }

    fn distance_field(&self, fractal: &Fractal) -> Arc<dyn DistanceField> {
        Arc::new(QuaternionJulia::of(fractal))
    }

    fn pack(&self, fractal: &Fractal, view: &PackedFor<'_>) -> Packed {
        let set = QuaternionJulia::of(fractal);
        let uniforms = Uniforms {
            constant: set.constant.as_vec4().to_array(),
            slice: set.slice as f32,
            limit: set.bailout.powi(2) as f32,
            log2_bailout: set.bailout.log2() as f32,
            iterations: view.iterations,
            max_step: (MAX_STEP * view.bounding_radius) as f32,
        };
        Packed {
            kernel: Kernel { formula: FormulaRef(&QUATERNION_JULIA), variant: 0 },
            uniforms: uniforms.to_bytes(),
            table: Arc::new([]),
        }
    }

    fn files(&self, _variant: u32) -> KernelFiles {
        KernelFiles {
            types: File { path: "quaternion_julia/types", text: include_str!("types.wgsl") },
            files: vec![File { path: "quaternion_julia/kernel", text: include_str!("kernel.wgsl") }],
        }
    }
}
