//! Formulas: one folder each, and the types that all formulas share.
//!
//! In: the values of a formula's parameters. Out: the formula's parameter table, its distance field in f64,
//! the WGSL files of its kernels and the uniforms that they read. Apart from presets and tests, no other code names
//! a formula's parameters or kernels: to add a formula, add its folder and its line in `formulas!`.
//!
//! | file | contents |
//! |---|---|
//! | [`contract`] | the trait of a formula, and the types that its methods take and give |
//! | [`document`] | a fractal in the scene document |
//! | [`table`] | a formula's parameters: kinds, labels, defaults |
//! | [`param`] | numbers with unit, range and help |
//! | [`bounds`] | spheres that hold a set |
//! | [`march`] | distance fields, and rays against them |
//! | [`recurrence`] | points whose orbits recur |
//! | [`mandelbulb`], [`quaternion_julia`] | the formulas |

pub mod bounds;
pub mod contract;
pub mod document;
pub mod march;
pub mod param;
pub mod recurrence;
pub mod table;

pub use contract::{
    Formula, FormulaRef, Fractal, Kernel, KernelFiles, MarchPolicy, Packed, PackedFor,
    ReferenceOrbit, ReferenceSteps,
};
pub use march::{DistanceField, Estimate, Ray};
pub use recurrence::{OrbitPosition, Recurrence};

/// Declares each formula's folder and lists the formulas in the order of the panels.
macro_rules! formulas {
    ($($folder:ident::$formula:ident),* $(,)?) => {
        $(pub mod $folder;)*

        /// Every formula; a new scene uses the first.
        const FORMULAS: &[FormulaRef] = &[$(FormulaRef(&$folder::$formula)),*];
    };
}

formulas! {
    mandelbulb::MANDELBULB,
    quaternion_julia::QUATERNION_JULIA,
}

/// Every formula.
pub fn all() -> impl Iterator<Item = FormulaRef> {
    FORMULAS.iter().copied()
}

impl Default for FormulaRef {
    fn default() -> Self {
        FORMULAS[0]
    }
}

impl Default for Fractal {
    fn default() -> Self {
        Self::new(FormulaRef::default())
    }
}
