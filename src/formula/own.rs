//! Formulas from texts that documents and people bring.
//!
//! In: a text. Out: a formula, the same one for the same text: pipelines and fields are found by formula.
//! Formulas stay in memory as long as the program, as their pipelines do.

use std::{
    collections::HashMap,
    sync::{LazyLock, Mutex, PoisonError},
};

use super::{
    FormulaRef,
    language::{TextError, TextFormula, tree::Span},
};

/// Most texts that one run of the program keeps.
const MAX_TEXTS: usize = 2000;

/// The formulas by their texts.
static OWN: LazyLock<Mutex<HashMap<String, FormulaRef>>> = LazyLock::new(Mutex::default);

/// The formula of `text`.
///
/// # Errors
///
/// The text's first error, with its place; or that this run has read too many texts.
pub fn of_text(text: &str) -> Result<FormulaRef, TextError> {
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
