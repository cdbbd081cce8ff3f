//! Formulas from texts that documents and people bring.
//!
//! In: a text. Out: a formula, the same one for the same text: pipelines and fields are found by formula.
//! Formulas stay in memory as long as the program, as their pipelines do.

use std::{
    collections::HashMap,
    sync::{LazyLock, Mutex, PoisonError},
};

use super::{
    FormulaRef, Fractal,
    language::{TextError, TextFormula, text_formula::is_transform, tree::Span},
    table::{Field, Value},
};

/// Most texts that one run of the program keeps.
const MAX_TEXTS: usize = 2000;

/// The formulas by their texts.
static OWN: LazyLock<Mutex<HashMap<String, FormulaRef>>> = LazyLock::new(Mutex::default);

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
    if let Some(&formula) = own.get(text) {
        return Ok(formula);
    }
    if own.len() >= MAX_TEXTS {
        let message = "too many formulas were tried since the program started: start it again";
        return Err(TextError::new(text, Span::default(), message));
    }
    let id: &'static str = Box::leak(format!("own_{}", own.len()).into_boxed_str());
    let formula = TextFormula::own(id, text)?;
    let formula = FormulaRef(Box::leak(Box::new(formula)));
    own.insert(text.to_owned(), formula);
    Ok(formula)
}
