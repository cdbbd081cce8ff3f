//! Hybrids: fractals whose steps are those of several formulas in turn.
//!
//! In: steps, each with a formula, parameters and a number of repeats. Out: a formula that draws them. Kernels are made
//! for a set of formulas; the steps' order, repeats and parameters are values that kernels read. Orbits grow, escape
//! and estimate distances as the leading step's formula says.

use std::{
    collections::HashMap,
    sync::{Arc, LazyLock, Mutex, PoisonError},
};

use super::{
    DistanceField, Formula, FormulaRef, Fractal, HybridStep, HybridSteps, KernelFiles, MarchPolicy,
    Packed, PackedFor, STEPS_ONLY, TextFormula, all,
    language::{
        check::Growth,
        graph::{Input, Node},
        kernel::Compiled,
        sequence::{MAX_STEPS, Sequence, SequenceStep},
        steps::Steps,
        text_formula::{as_text, julia_constant, julia_fields, kept},
        uniforms::MAX_SLOTS,
    },
    own,
    param::{ITERATIONS, params},
    table::{Field, Value},
};

pub use super::language::text_formula::is_transform;

params! {
    /// The numbers of a hybrid and of its steps.
    PARAMS;
    LOOP_START = "fractal.loop_start", "Loop start", Count, 0.0, 8.0, default 0.0, Integer by 1.0,
        "Number of first steps that are taken only once. The loop repeats the steps after them.";
    REPEATS = "fractal.steps[].repeats", "Repeats", Count, 1.0, 50.0, default 1.0, Integer by 1.0,
        "How often the step is taken before the next one.";
}

/// Most operations of one step of each of a hybrid's formulas, in all.
pub const MAX_OPERATIONS: usize = 1024;
/// Largest bailout of a new hybrid with steps that grow as a power: its powers may not overflow.
const LARGEST_POWER_BAILOUT: f64 = 16.0;
/// Most sets of formulas that one run of the program keeps.
const MAX_SETS: usize = 1000;

/// Why steps are no hybrid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HybridError {
    /// The number of steps.
    #[error("a hybrid has 1 to {MAX_STEPS} steps, and this one has {0}")]
    Count(usize),
    /// Nothing is left for the loop.
    #[error("loop_start is {start}, but there are {steps} steps: the loop would be empty")]
    Loop {
        /// The loop's start.
        start: usize,
        /// Number of steps.
        steps: usize,
    },
    /// Operations of the formulas in all.
    #[error(
        "the formulas have {0} operations in all, and may have {MAX_OPERATIONS}: leave one out"
    )]
    Operations(usize),
    /// A formula whose kernels cannot be mixed.
    #[error("`{0}` cannot be a step of a hybrid")]
    NoText(&'static str),
    /// A formula whose state needs dr, among formulas without it.
    #[error(
        "{0} does not mix with these formulas: its step reads `dr`, which another step does not assign"
    )]
    NeedsDerivative(&'static str),
    /// Values that the host computes.
    #[error("`{0}` computes too many values from its parameters")]
    Slots(&'static str),
    /// Too many sets of formulas.
    #[error(
        "too many hybrids were tried since the program started: restart it, or reload the page"
    )]
    Sets,
}

/// A step of `formula` with its default values.
///
/// # Errors
///
/// [`HybridError::NoText`] if the formula has no form in the language.
pub fn step(formula: FormulaRef) -> Result<HybridStep, HybridError> {
    let formula = match as_text(formula) {
        Some(_) => formula,
        // A formula with kernels of its own has a text of the same name.
        None => find_step(formula.id()).ok_or(HybridError::NoText(formula.id()))?,
    };
    let fields = as_text(formula).map(TextFormula::own_fields).unwrap_or_default();
    Ok(HybridStep::new(formula, fields))
}

/// The step of a fractal that is no hybrid, with those of its values that the step has too.
///
/// # Errors
///
/// As [`step`].
pub fn step_of(fractal: &Fractal) -> Result<HybridStep, HybridError> {
    let mut step = step(fractal.formula())?;
    for (field, value) in step.fields_mut() {
        if let Some(known) = fractal.get(field.name).filter(|known| known.fits(field)) {
            *value = known.clone();
        }
        // A choice of a formula with kernels of its own is a switch in its text.
        if fractal.values().contains(&Value::Choice(field.name)) {
            *value = Value::Switch(true);
        }
    }
    Ok(step)
}

/// The fractal that a step's formula draws alone, with the step's values and those of `before` that fit.
///
/// None for transforms.
pub fn alone(before: &Fractal, step: &HybridStep) -> Option<Fractal> {
    if is_transform(step.formula()) {
        return None;
    }
    // A step may stand for a formula with kernels of its own.
    let id = step.formula().id();
    let formula = all().find(|one| one.id() == id).unwrap_or(step.formula());
    let mut fractal = own::with_values_of(formula, before);
    for (field, value) in step.fields() {
        fractal.set(field.name, value.clone());
    }
    Some(fractal)
}

/// A hybrid of `steps`, with default values.
///
/// # Errors
///
/// See [`HybridError`].
pub fn fractal(steps: HybridSteps) -> Result<Fractal, HybridError> {
    Ok(Fractal::of_steps(formula_of(&steps)?, steps))
}

/// The hybrid of `steps`, with those values of `before` that are of the whole hybrid and fit.
///
/// # Errors
///
/// See [`HybridError`].
pub fn with_steps(before: &Fractal, steps: HybridSteps) -> Result<Fractal, HybridError> {
    let mut new = fractal(steps)?;
    if before.hybrid().is_some() {
        (new.iterations, new.bailout) = (before.iterations, before.bailout);
    }
    new.section_planes.clone_from(&before.section_planes);
    for (field, value) in new.fields_mut() {
        if let Some(known) = before.get(field.name).filter(|known| known.fits(field)) {
            *value = known.clone();
        }
    }
    Ok(new)
}

fn text_of(step: &HybridStep) -> Option<&'static TextFormula> {
    as_text(step.formula())
}

/// The formula that draws the steps.
fn formula_of(hybrid: &HybridSteps) -> Result<FormulaRef, HybridError> {
    let HybridSteps { steps, loop_start } = hybrid;
    if !(1..=MAX_STEPS).contains(&steps.len()) {
        return Err(HybridError::Count(steps.len()));
    }
    if *loop_start >= steps.len() {
        return Err(HybridError::Loop { start: *loop_start, steps: steps.len() });
    }
    let mut formulas: Vec<_> = steps.iter().filter_map(text_of).collect();
    formulas.sort_by_key(|text| text.id());
    formulas.dedup_by_key(|text| text.id());
    of_formulas(&formulas)
}

/// The place of the step whose formula computes an orbit's size and distance.
///
/// The loop's first step that grows as a power, else the first that grows, else the first.
fn leading(hybrid: &HybridSteps) -> usize {
    let HybridSteps { steps, loop_start } = hybrid;
    let growth = |i: usize| text_of(&steps[i]).map(|text| text.checked().growth);
    let find = |wanted: Growth| (*loop_start..steps.len()).find(|&i| growth(i) == Some(wanted));
    find(Growth::Power).or_else(|| find(Growth::Linear)).unwrap_or(*loop_start)
}

/// The hybrids by the ids of their formulas, in order.
static HYBRIDS: LazyLock<Mutex<HashMap<Vec<&'static str>, FormulaRef>>> =
    LazyLock::new(Mutex::default);

/// The formula of a set of texts, which are ordered by id.
fn of_formulas(texts: &[&'static TextFormula]) -> Result<FormulaRef, HybridError> {
    let ids: Vec<_> = texts.iter().map(|text| text.id()).collect();
    // Each insertion is complete, so the map is valid even if a thread panicked with the lock.
    let mut hybrids = HYBRIDS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(&formula) = hybrids.get(&ids) {
        return Ok(formula);
    }
    if hybrids.len() >= MAX_SETS {
        return Err(HybridError::Sets);
    }
    let formula = Hybrid::new(kept(format!("hybrid_{}", hybrids.len())), texts)?;
    let formula = FormulaRef(Box::leak(Box::new(formula)));
    hybrids.insert(ids, formula);
    Ok(formula)
}

/// The formula of hybrids of one set of formulas.
#[derive(Debug)]
struct Hybrid {
    id: &'static str,
    about: &'static str,
    fields: &'static [Field],
    formulas: Vec<&'static TextFormula>,
    steps: Steps,
}

impl Hybrid {
    fn new(id: &'static str, texts: &[&'static TextFormula]) -> Result<Self, HybridError> {
        let size = texts.iter().map(|text| text.checked().size).max().unwrap_or(3);
        let has_derivatives = texts.iter().all(|text| text.checked().derivative.is_some());
        let operations = texts.iter().map(|text| text.checked().operation_count()).sum();
        if operations > MAX_OPERATIONS {
            return Err(HybridError::Operations(operations));
        }
        let mut compiled = Vec::new();
        for text in texts {
            let mut checked = text.checked().clone().widened(size);
            if !has_derivatives {
                checked.derivative = None;
                let needed = checked.graph.needed(&checked.step, |_| false);
                let is_derivative =
                    |node| matches!(node, Node::Input(Input::Derivative | Input::AddendDerivative));
                if needed.iter().any(|&id| is_derivative(checked.graph.node(id))) {
                    return Err(HybridError::NeedsDerivative(text.name()));
                }
            }
            let made = Compiled::new(checked);
            if made.slots.len() > MAX_SLOTS {
                return Err(HybridError::Slots(text.name()));
            }
            compiled.push(made);
        }
        let has_addend = texts.iter().any(|text| text.checked().has_addend);
        let fields = if has_addend { julia_fields(size).to_vec() } else { Vec::new() };
        let names: Vec<_> = texts.iter().map(|text| text.name()).collect();
        Ok(Self {
            id,
            about: kept(format!("Steps in turn: {}", names.join(", "))),
            fields: fields.leak(),
            formulas: texts.to_vec(),
            steps: Steps::several(id, &compiled),
        })
    }

    fn sequence(&self, fractal: &Fractal) -> Sequence {
        let Some(HybridSteps { steps, loop_start }) = fractal.hybrid() else {
            // A fractal of this formula has steps; without them none is taken.
            let step = SequenceStep { formula: 0, repeats: 1, params: Vec::new() };
            return Sequence { steps: vec![step], loop_start: 0, leading: 0 };
        };
        let step = |step: &HybridStep| SequenceStep {
            formula: self
                .formulas
                .iter()
                .position(|one| one.id() == step.formula().id())
                .unwrap_or(0),
            repeats: step.repeats,
            params: text_of(step).map_or_else(Vec::new, |text| text.param_values(step.values())),
        };
        Sequence {
            steps: steps.iter().map(step).collect(),
            loop_start: *loop_start,
            leading: fractal.hybrid().map_or(0, leading),
        }
    }
}

impl Formula for Hybrid {
    fn id(&self) -> &'static str {
        self.id
    }

    fn name(&self) -> &'static str {
        "Hybrid"
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn channel(&self) -> Option<&'static str> {
        self.formulas.iter().find_map(|text| text.channel())
    }

    fn fields(&self) -> &'static [Field] {
        self.fields
    }

    fn default_iterations(&self) -> Option<u32> {
        let usual = ITERATIONS.default as u32;
        self.formulas.iter().map(|text| text.default_iterations().unwrap_or(usual)).max()
    }

    fn default_bailout(&self) -> Option<f64> {
        let all = self.formulas.iter().filter_map(|text| text.default_bailout());
        let largest = all.fold(super::param::BAILOUT.default, f64::max);
        let has_power = self.formulas.iter().any(|text| text.checked().growth == Growth::Power);
        Some(if has_power { largest.min(LARGEST_POWER_BAILOUT) } else { largest })
    }

    fn max_bailout(&self, fractal: &Fractal) -> f64 {
        // Defaults of a hybrid's formula are asked for without steps.
        let has_steps = fractal.hybrid().is_some();
        if has_steps { self.steps.max_bailout(&self.sequence(fractal)) } else { f64::INFINITY }
    }

    fn march_policy(&self, _fractal: &Fractal) -> MarchPolicy {
        self.steps.march_policy()
    }

    fn iterations_for(&self, fractal: &Fractal, footprint: f64) -> u32 {
        Steps::iterations_for(fractal, footprint)
    }

    fn distance_field(&self, fractal: &Fractal) -> Arc<dyn DistanceField> {
        Arc::new(self.steps.field(self.sequence(fractal), fractal, julia_constant(fractal)))
    }

    fn pack(&self, fractal: &Fractal, view: &PackedFor<'_>) -> Packed {
        self.steps.pack(&self.sequence(fractal), fractal, julia_constant(fractal), view)
    }

    fn files(&self, _variant: u32) -> KernelFiles {
        self.steps.files().clone()
    }

    fn overrides(&self, _variant: u32) -> Vec<(&'static str, f64)> {
        self.steps.overrides()
    }

    fn describe(&self, _variant: u32) -> String {
        format!(
            "the hybrid of {}",
            self.formulas.iter().map(|text| text.name()).collect::<Vec<_>>().join(", ")
        )
    }
}

/// Every formula that a hybrid's steps may have: those that draw alone, then the others, by name.
pub fn step_formulas() -> impl Iterator<Item = FormulaRef> {
    all().filter(|&formula| as_text(formula).is_some()).chain(STEPS_ONLY.iter().copied())
}

/// The formula called `id` in a hybrid's step.
pub fn find_step(id: &str) -> Option<FormulaRef> {
    step_formulas().find(|formula| formula.id() == id)
}
