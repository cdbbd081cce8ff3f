//! The contract between a formula and the program: the trait that a formula implements, and the types
//! that its methods take and give: fractals, with the steps of hybrids, and kernels. They name each other, so they share a file.

use std::{any::Any, fmt, hash, ops::Deref, sync::Arc};

use glam::DVec3;

use super::{
    kernel_files::KernelFiles,
    march::{DistanceField, MarchPolicy, StepLimits},
    param,
    recurrence::Recurrence,
    section::{self, SectionPlane},
    table::{Field, Value},
    trap::Trap,
};
use crate::precise::PrecisePoint;

/// One formula. Each `fractal` argument must be of this formula and within its ranges.
pub trait Formula: Any + Sync {
    /// The formula's identifier in the document.
    fn id(&self) -> &'static str;

    /// The formula's name in panels.
    fn name(&self) -> &'static str;

    /// What the formula draws, in one sentence.
    fn about(&self) -> &'static str;

    /// The text that documents carry instead of the id; none for formulas that come with the program.
    fn text(&self) -> Option<&'static str> {
        None
    }

    /// The name of the formula's colour channel in panels; none if it has none.
    fn channel(&self) -> Option<&'static str> {
        None
    }

    /// The formula's own parameters in document order, without iterations and bailout.
    fn fields(&self) -> &'static [Field];

    /// The iterations of a new scene; none for the default of [`param::ITERATIONS`].
    fn default_iterations(&self) -> Option<u32> {
        None
    }

    /// The bailout of a new scene; none for the default of [`param::BAILOUT`].
    fn default_bailout(&self) -> Option<f64> {
        None
    }

    /// The largest bailout with which no step overflows an f32.
    fn max_bailout(&self, _fractal: &Fractal) -> f64 {
        f64::INFINITY
    }

    /// How rays march through `fractal`.
    fn march_policy(&self, _fractal: &Fractal) -> MarchPolicy {
        MarchPolicy::default()
    }

    /// Iterations of a view whose pixels have radius `footprint` at the nearest surface.
    ///
    /// `footprint` is in scene units. The result is the scene's own iterations plus those that orbits of
    /// points a footprint apart need to separate.
    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32;

    /// The distance field about the scene's origin.
    fn distance_field(&self, fractal: &Fractal) -> Arc<dyn DistanceField>;

    /// Whether views of `fractal` finer than f32 allows can be drawn about an anchor.
    fn has_depth(&self, _fractal: &Fractal) -> bool {
        false
    }

    /// A phrase that names the fractals with depth, shown where a dive ends.
    ///
    /// None if no fractal of the formula has depth.
    fn deeper(&self) -> Option<&'static str> {
        None
    }

    /// Begins the reference orbit of `anchor`; none without [depth](Self::has_depth).
    fn begin_reference(
        &self,
        _fractal: &Fractal,
        _anchor: PrecisePoint,
    ) -> Option<Box<dyn ReferenceSteps>> {
        None
    }

    /// The error of `recurrence` at the exact orbit of `point`, computed with many digits.
    ///
    /// None without [depth](Self::has_depth), and where the orbit escapes first.
    fn recurrence_error(
        &self,
        _fractal: &Fractal,
        _point: &PrecisePoint,
        _recurrence: Recurrence,
    ) -> Option<DVec3> {
        None
    }

    /// Packs the uniforms of a view and selects the kernel that draws it.
    fn pack(&self, fractal: &Fractal, view: &PackedFor<'_>) -> Packed;

    /// The WGSL files of the kernels of `variant`.
    fn files(&self, variant: u32) -> KernelFiles;

    /// The overrides that specialize the kernels of `variant`.
    fn overrides(&self, _variant: u32) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// The general variant: draws what `variant` draws, for any values of the parameters.
    ///
    /// None if there is no such variant. Variant 0 is the general variant of plain views.
    fn general(&self, variant: u32) -> Option<u32> {
        Some(variant)
    }

    /// Variants that a dive into `fractal` passes through, from the top down, to compile beforehand.
    ///
    /// The dive starts from a view that `variant` draws.
    fn dive_variants(&self, _fractal: &Fractal, _variant: u32) -> Vec<u32> {
        Vec::new()
    }

    /// Whether kernels of `variant` draw deep views, about an anchor.
    fn is_deep(&self, _variant: u32) -> bool {
        false
    }

    /// What kernels of `variant` draw, as a phrase that follows "Preparing".
    fn describe(&self, _variant: u32) -> String {
        self.name().to_owned()
    }
}

/// A registered formula; two are equal if they have the same [id](Formula::id).
#[derive(Clone, Copy)]
pub struct FormulaRef(pub &'static dyn Formula);

impl Deref for FormulaRef {
    type Target = dyn Formula;

    fn deref(&self) -> &Self::Target {
        self.0
    }
}

impl PartialEq for FormulaRef {
    fn eq(&self, other: &Self) -> bool {
        self.id() == other.id()
    }
}

impl Eq for FormulaRef {}

impl hash::Hash for FormulaRef {
    fn hash<H: hash::Hasher>(&self, state: &mut H) {
        self.id().hash(state);
    }
}

impl fmt::Debug for FormulaRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// A formula with the values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Fractal {
    formula: FormulaRef,
    /// Most orbit steps of a view of the whole set, in [`param::ITERATIONS`]; finer views add to them.
    pub iterations: u32,
    /// Escape radius in scene units, in [`param::BAILOUT`] and at most [`Fractal::max_bailout`].
    pub bailout: f64,
    /// One value per field of the formula, in the table's order.
    values: Vec<Value>,
    /// The steps of a hybrid; none for formulas that draw alone.
    hybrid: Option<Box<HybridSteps>>,
    /// Planes that cut the set open, at most [`MAX_SECTION_PLANES`](super::section::MAX_SECTION_PLANES).
    pub section_planes: Vec<SectionPlane>,
}

/// The steps of a hybrid. [`super::hybrid`] makes fractals of them.
#[derive(Clone, Debug, PartialEq)]
pub struct HybridSteps {
    /// The steps in order.
    pub steps: Vec<HybridStep>,
    /// The step that follows the last one; steps before it are taken once.
    pub loop_start: usize,
}

/// One step of a hybrid.
#[derive(Clone, Debug)]
pub struct HybridStep {
    formula: FormulaRef,
    fields: &'static [Field],
    /// One value per field.
    values: Vec<Value>,
    /// How often the step is taken before the next one, in [`super::hybrid::REPEATS`].
    pub repeats: u32,
}

impl PartialEq for HybridStep {
    fn eq(&self, other: &Self) -> bool {
        // The fields are the formula's.
        (self.formula, &self.values, self.repeats) == (other.formula, &other.values, other.repeats)
    }
}

impl HybridStep {
    /// A step of `formula`, whose parameters in hybrids are `fields`, with default values.
    pub(super) fn new(formula: FormulaRef, fields: &'static [Field]) -> Self {
        let values = fields.iter().map(Field::default).collect();
        Self { formula, fields, values, repeats: 1 }
    }

    /// The formula.
    pub fn formula(&self) -> FormulaRef {
        self.formula
    }

    /// The step's fields with their values, in the table's order.
    pub fn fields(&self) -> impl Iterator<Item = (&'static Field, &Value)> {
        self.fields.iter().zip(&self.values)
    }

    /// The step's fields with their values, mutable.
    pub fn fields_mut(&mut self) -> impl Iterator<Item = (&'static Field, &mut Value)> {
        self.fields.iter().zip(&mut self.values)
    }

    /// The values, in the table's order.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// Sets the field called `name`, and returns whether it did.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> bool {
        set(self.fields_mut(), name, value.into())
    }
}

/// Gives the field called `name` a value that fits it; false if there is none.
fn set<'a>(
    mut fields: impl Iterator<Item = (&'static Field, &'a mut Value)>,
    name: &str,
    new: Value,
) -> bool {
    let found = fields.find(|(field, _)| field.name == name && new.fits(field));
    found.map(|(_, value)| *value = new).is_some()
}

impl Fractal {
    /// A fractal of `formula` with the default values.
    pub fn new(formula: FormulaRef) -> Self {
        Self::with_defaults(formula, None)
    }

    /// A fractal of `formula`, which is that of `steps`, with default values.
    pub(super) fn of_steps(formula: FormulaRef, steps: HybridSteps) -> Self {
        Self::with_defaults(formula, Some(Box::new(steps)))
    }

    fn with_defaults(formula: FormulaRef, hybrid: Option<Box<HybridSteps>>) -> Self {
        let mut fractal = Self {
            formula,
            iterations: formula.default_iterations().unwrap_or(param::ITERATIONS.default as u32),
            bailout: formula.default_bailout().unwrap_or(param::BAILOUT.default),
            values: formula.fields().iter().map(Field::default).collect(),
            hybrid,
            section_planes: Vec::new(),
        };
        fractal.bailout = fractal.bailout.min(fractal.max_bailout());
        fractal
    }

    /// The steps of a hybrid; none for formulas that draw alone.
    pub fn hybrid(&self) -> Option<&HybridSteps> {
        self.hybrid.as_deref()
    }

    /// The steps of a hybrid, for changes of their values and repeats.
    pub fn steps_mut(&mut self) -> &mut [HybridStep] {
        self.hybrid.as_deref_mut().map_or(&mut [], |hybrid| &mut hybrid.steps)
    }

    /// The same fractal with `iterations`.
    pub fn with_iterations(&self, iterations: u32) -> Self {
        Self { iterations, ..self.clone() }
    }

    /// The formula.
    pub fn formula(&self) -> FormulaRef {
        self.formula
    }

    /// The distance field about the scene's origin of what the section planes leave.
    pub fn distance_field(&self) -> Arc<dyn DistanceField> {
        section::cut(self.formula.distance_field(self), &self.section_planes)
    }

    /// The distance field about the anchor of `reference` of what the section planes leave.
    ///
    /// `footprint` and `grain` as in [`ReferenceOrbit::distance_field`].
    pub fn field_about(
        &self,
        reference: Arc<dyn ReferenceOrbit>,
        footprint: f64,
        grain: f64,
    ) -> Arc<dyn DistanceField> {
        section::cut(reference.distance_field(self, footprint, grain), &self.section_planes)
    }

    /// The formula's fields with their values, in the table's order.
    pub fn fields(&self) -> impl Iterator<Item = (&'static Field, &Value)> {
        self.formula.fields().iter().zip(&self.values)
    }

    /// The formula's fields with their values, mutable.
    pub fn fields_mut(&mut self) -> impl Iterator<Item = (&'static Field, &mut Value)> {
        self.formula.fields().iter().zip(&mut self.values)
    }

    /// The value of the field called `name`; none if the formula has no such field.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.fields().find_map(|(field, value)| (field.name == name).then_some(value))
    }

    /// The number called `name`; none if the formula has no such number.
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// Whether the switch called `name` is on; false if the formula has no such switch.
    pub fn is_on(&self, name: &str) -> bool {
        self.get(name) == Some(&Value::Switch(true))
    }

    /// Sets the field called `name`, and returns whether it did.
    ///
    /// Returns false, and changes nothing, if the formula has no such field or `value` is of another kind.
    pub fn set(&mut self, name: &str, value: impl Into<Value>) -> bool {
        set(self.fields_mut(), name, value.into())
    }

    /// The values, in the table's order.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    /// The largest bailout that overflows no step, within [`param::BAILOUT`]'s range.
    pub fn max_bailout(&self) -> f64 {
        self.formula.max_bailout(self).min(param::BAILOUT.max)
    }

    /// The parameter of the field at `path`, such as `fractal.power`.
    ///
    /// The formula's own parameters come before those that all formulas share.
    pub fn param(&self, path: &str) -> Option<&'static param::Param> {
        let own = self.formula.fields().iter().filter_map(Field::param);
        own.chain(param::SHARED.iter().copied()).find(|param| param.is_at(path))
    }
}

/// What the pipelines of rays and normals are compiled for: a formula and a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Kernel {
    /// The formula.
    pub formula: FormulaRef,
    /// The formula's variant, numbered by the formula itself.
    pub variant: u32,
}

impl Kernel {
    /// The general variant of this kernel, which draws the same for any parameter values.
    ///
    /// None for deep kernels of formulas that compile the values in.
    pub fn general(self) -> Option<Self> {
        Some(Self { variant: self.formula.general(self.variant)?, ..self })
    }

    /// Whether the kernel draws any values of the parameters.
    pub fn is_general(self) -> bool {
        self.general() == Some(self)
    }

    /// Whether the kernel draws deep views, about an anchor.
    pub fn is_deep(self) -> bool {
        self.formula.is_deep(self.variant)
    }

    /// The kernel's WGSL files.
    pub fn files(self) -> KernelFiles {
        self.formula.files(self.variant)
    }

    /// The overrides that specialize the kernel.
    pub fn overrides(self) -> Vec<(&'static str, f64)> {
        self.formula.overrides(self.variant)
    }

    /// What the kernel draws, as a phrase that follows "Preparing".
    pub fn describe(self) -> String {
        self.formula.describe(self.variant)
    }
}

/// The view data that a formula reads to [pack](super::Formula::pack) its uniforms.
#[derive(Clone, Copy, Debug)]
pub struct PackedFor<'a> {
    /// Most steps of an orbit.
    pub iterations: u32,
    /// Length of one unit of render space, in scene units.
    pub scale: f64,
    /// Hit distance per unit of depth.
    pub hit_cone: f32,
    /// The reference orbit of the anchor that points are relative to; none in plain views.
    pub reference: Option<&'a Arc<dyn ReferenceOrbit>>,
    /// Radius about the scene's origin of a sphere that holds the set, in scene units.
    pub bounding_radius: f64,
    /// The orbit traps of the colour layers; none for layers with other values.
    pub traps: [Option<Trap>; 2],
}

/// The uniforms of one frame, and the kernel that reads them.
#[derive(Clone, Debug, PartialEq)]
pub struct Packed {
    /// The kernel.
    pub kernel: Kernel,
    /// The bytes of `FormulaUniforms`, at most [`MAX_UNIFORM_BYTES`].
    pub uniforms: Vec<u8>,
    /// The bytes of the uniform buffer at group 0, binding 1; empty if the kernel reads none.
    ///
    /// At most [`MAX_TABLE_BYTES`].
    pub table: Arc<[u8]>,
    /// Limits of steps by the Jacobian at one point; none if a product of bounds sets the steps.
    pub step_limits: Option<StepLimits>,
    /// Number of steps that a series approximation replaces in all orbits near the anchor; 0 without one.
    pub series_steps: u32,
}

/// Maximum size of `FormulaUniforms`, in bytes.
pub const MAX_UNIFORM_BYTES: usize = 640;

/// Maximum size of a formula's table in bytes: every adapter can bind this much as a uniform buffer.
pub const MAX_TABLE_BYTES: usize = 65_536;

/// An anchor and its orbit, with enough digits for the deepest view about the anchor.
pub trait ReferenceOrbit: fmt::Debug + Any + Send + Sync {
    /// The anchor: the point that positions are relative to.
    fn anchor(&self) -> &PrecisePoint;

    /// Whether the orbit belongs to `fractal`; iterations are not compared.
    fn is_of(&self, fractal: &Fractal) -> bool;

    /// Iterations of a view of `fractal` about the anchor, for pixels of radius `footprint` at the surface.
    ///
    /// `footprint` is in scene units. At least [`Formula::iterations_for`]; more where the anchor's orbit is slow to
    /// separate from its neighbours'.
    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32;

    /// The distance field about the anchor, for pixels of radius `footprint` at the surface.
    ///
    /// `footprint` sets the iterations. Rays may ignore detail finer than `grain`. Both are in scene units.
    fn distance_field(
        self: Arc<Self>,
        fractal: &Fractal,
        footprint: f64,
        grain: f64,
    ) -> Arc<dyn DistanceField>;
}

/// A reference orbit under construction. A step takes some microseconds.
pub trait ReferenceSteps: Send + Sync {
    /// Computes the orbit's next point; returns false once all points are computed.
    fn step(&mut self) -> bool;

    /// Computes the remaining points and returns the reference orbit.
    fn finish(self: Box<Self>) -> Arc<dyn ReferenceOrbit>;
}
