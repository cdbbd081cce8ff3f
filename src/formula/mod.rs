//! Formulas: the Mandelbulb with kernels of its own, and formulas from texts.
//!
//! In: the values of a formula's parameters. Out: the formula's parameter table, its distance field in f64,
//! the WGSL files of its kernels and the uniforms that they read. Apart from presets and tests, no other code names
//! a formula's parameters or kernels: to add a formula, add its text to `formulas/`.
//!
//! | file | contents |
//! |---|---|
//! | [`contract`] | the trait of a formula, and the types that its methods take and give |
//! | [`kernel_files`] | what a formula's WGSL files declare |
//! | [`document`] | a fractal in the scene document |
//! | [`language`] | formulas from texts |
//! | [`hybrid`] | steps of several formulas in turn |
//! | [`own`] | texts that documents and people bring |
//! | [`table`] | a formula's parameters: kinds, labels, defaults |
//! | [`param`] | numbers with unit, range and help |
//! | [`trap`] | orbit traps |
//! | [`section`] | planes that cut the set open |
//! | [`bounds`] | spheres that hold a set |
//! | [`march`] | distance fields, and rays against them |
//! | [`recurrence`] | points whose orbits recur |
//! | [`mandelbulb`] | the formula with kernels of its own; `formulas/` has the texts of the others |

use std::sync::LazyLock;

use include_dir::{Dir, File, include_dir};

pub mod bounds;
pub mod contract;
pub mod document;
pub mod hybrid;
pub mod kernel_files;
pub mod language;
pub mod mandelbulb;
pub mod march;
pub mod own;
pub mod param;
pub mod recurrence;
pub mod section;
pub mod table;
pub mod trap;

pub use contract::{
    Formula, FormulaRef, Fractal, HybridStep, HybridSteps, Kernel, Packed, PackedFor,
    ReferenceOrbit, ReferenceSteps,
};
pub use kernel_files::KernelFiles;
pub use language::{TextError, TextFormula};
pub use march::{DistanceField, Estimate, MarchPolicy, Ray, StepLimits};
pub use recurrence::{OrbitPosition, Recurrence};

/// The folder of formula texts: one file per formula, whose stem is the formula's id.
static TEXTS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/formulas");

/// Every formula: those with kernels of their own, then the texts by name. A new scene uses the first.
static FORMULAS: LazyLock<Vec<FormulaRef>> = LazyLock::new(|| {
    let texts = formulas_in(&TEXTS);
    [FormulaRef(&mandelbulb::MANDELBULB)].into_iter().chain(texts).collect()
});

/// The formulas of `formulas/steps/` by name: steps of hybrids only.
///
/// They are transforms, and formulas with kernels of their own in the language.
static STEPS_ONLY: LazyLock<Vec<FormulaRef>> =
    LazyLock::new(|| TEXTS.get_dir("steps").map_or_else(Vec::new, formulas_in));

/// The ids and texts of `formulas/`, by id.
pub fn texts() -> impl Iterator<Item = (&'static str, &'static str)> {
    texts_in(&TEXTS)
}

/// The ids and texts of `formulas/steps/`, by id.
pub fn step_texts() -> impl Iterator<Item = (&'static str, &'static str)> {
    TEXTS.get_dir("steps").into_iter().flat_map(texts_in)
}

fn texts_in(folder: &'static Dir<'static>) -> impl Iterator<Item = (&'static str, &'static str)> {
    let of = |file: &'static File<'static>| {
        Some((file.path().file_stem()?.to_str()?, file.contents_utf8()?))
    };
    folder.files().filter_map(of)
}

/// The formulas of a folder of texts, by name.
fn formulas_in(folder: &'static Dir<'static>) -> Vec<FormulaRef> {
    let mut all: Vec<_> = texts_in(folder).map(|(id, text)| text_formula(id, text)).collect();
    all.sort_by_key(|formula| formula.name());
    all
}

/// The formula of a text of the program.
///
/// # Panics
///
/// If the text has an error: a test compiles every text.
fn text_formula(id: &'static str, text: &str) -> FormulaRef {
    let formula =
        TextFormula::new(id, text).unwrap_or_else(|error| panic!("{id}.formula: {error}"));
    FormulaRef(Box::leak(Box::new(formula)))
}

/// Every formula.
pub fn all() -> impl Iterator<Item = FormulaRef> {
    FORMULAS.iter().copied()
}

/// The formula called `id` in documents.
pub fn find(id: &str) -> Option<FormulaRef> {
    all().find(|formula| formula.id() == id)
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
