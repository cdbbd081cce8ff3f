//! Formulas from texts that documents and people bring.
//!
//! In: a text. Out: a formula, the same one for the same text: pipelines and fields are found by formula.
//! Formulas stay in memory as long as the program, as their pipelines do.

use std::{
    cell::Cell,
    collections::HashMap,
    sync::{LazyLock, Mutex, PoisonError},
};

use super::{
    FormulaRef, Fractal,
    language::{TextError, TextFormula, text_formula::is_transform, tree::Span},
    table::{Field, Value},
};

/// Most nodes of formulas that one run of the program keeps: some hundred megabytes.
const MAX_NODES: usize = 1_000_000;
/// Most new texts that one document may bring.
pub const MAX_IN_DOCUMENT: usize = 64;

/// The formulas of texts, which stay as long as the program.
#[derive(Default)]
struct Kept {
    by_text: HashMap<String, FormulaRef>,
    /// Number of nodes of all of them.
    nodes: usize,
}

static OWN: LazyLock<Mutex<Kept>> = LazyLock::new(Mutex::default);

thread_local! {
    /// Number of new texts that the document which is read may still bring; none while no document is read.
    static LEFT_IN_DOCUMENT: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Reads a document: with more than `MAX_IN_DOCUMENT` new texts, reading ends with an error.
pub fn in_document<T>(read: impl FnOnce() -> T) -> T {
    LEFT_IN_DOCUMENT.set(Some(MAX_IN_DOCUMENT));
    let result = read();
    LEFT_IN_DOCUMENT.set(None);
    result
}

/// A fractal of `formula` with the values that `old` has changed, where `formula` has such parameters.
///
/// The same holds for iterations and bailout. Section planes stay.
pub fn with_values_of(formula: FormulaRef, old: &Fractal) -> Fractal {
    let mut new = Fractal::new(formula);
    for (field, value) in old.fields().filter(|(field, value)| field.default() != **value) {
        let target = formula.fields().iter().find(|other| other.name == field.name);
        let is_in_range =
            |x: &f64| target.and_then(Field::param).is_none_or(|param| param.accepts(*x));
        let is_valid = match value {
            Value::Number(number) => is_in_range(number),
            Value::Vector(numbers) => numbers.iter().all(is_in_range),
            Value::Switch(_) | Value::Choice(_) => true,
        };
        if is_valid {
            new.set(field.name, value.clone());
        }
        // A choice of a formula with kernels of its own is a switch in its text.
        if let Value::Choice(word) = value {
            new.set(word, true);
        }
    }
    new.section_planes.clone_from(&old.section_planes);
    let usual = Fractal::new(old.formula());
    if old.iterations != usual.iterations {
        new.iterations = old.iterations;
    }
    if old.bailout != usual.bailout {
        new.bailout = old.bailout.min(new.max_bailout());
    }
    new
}

/// The formula of `text`, which draws alone.
///
/// # Errors
///
/// As [`of_text`]; and that the text has no distance estimate.
pub fn alone(text: &str) -> Result<FormulaRef, TextError> {
    let formula = of_text(text)?;
    if is_transform(formula) {
        let message =
            "`estimate none` is for steps of hybrids: a formula that draws alone needs an estimate";
        let start = text.rfind("estimate").unwrap_or_default();
        let end = (start + "estimate".len()).min(text.len());
        return Err(TextError::new(text, Span { start, end }, message));
    }
    Ok(formula)
}

/// The formula of `text`: the program's own one that draws alone, if it has that text.
///
/// # Errors
///
/// The text's first error, with its place; or that this run has read too many texts.
pub fn of_text(text: &str) -> Result<FormulaRef, TextError> {
    let mut of_program = super::texts().chain(super::step_texts());
    if let Some((id, _)) = of_program.find(|(_, known)| *known == text)
        && let Some(formula) = super::find(id)
    {
        return Ok(formula);
    }
    // Each insertion is complete, so the map is valid even if a thread panicked with the lock.
    let mut own = OWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(&formula) = own.by_text.get(text) {
        return Ok(formula);
    }
    let refused = |message: String| Err(TextError::new(text, Span::default(), message));
    if own.nodes >= MAX_NODES {
        let message = "too many formulas were tried since the program started: restart it, or reload the page";
        return refused(message.to_owned());
    }
    if let Some(left) = LEFT_IN_DOCUMENT.get() {
        if left == 0 {
            return refused(format!("a document may bring {MAX_IN_DOCUMENT} formulas of its own"));
        }
        LEFT_IN_DOCUMENT.set(Some(left - 1));
    }
    let formula = TextFormula::own(&format!("own_{}", own.by_text.len()), text)?;
    own.nodes += formula.size();
    let formula = FormulaRef(Box::leak(Box::new(formula)));
    own.by_text.insert(text.to_owned(), formula);
    Ok(formula)
}
