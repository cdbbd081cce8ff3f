//! `mandelight formulas` and `mandelight formula check`: the formulas, and texts of one's own.

use std::{fs, path::PathBuf};

use clap::{Args, Subcommand};
use mandelight::{
    formula::{self, FormulaRef, TextError, hybrid, own},
    reading::visible,
};

use super::{Failure, print, shown};

/// The arguments of `mandelight formulas`.
#[derive(Args)]
pub struct FormulasArguments {}

/// The arguments of `mandelight formula`.
#[derive(Args)]
pub struct FormulaArguments {
    #[command(subcommand)]
    command: FormulaCommand,
}

#[derive(Subcommand)]
enum FormulaCommand {
    /// Checks a formula's text and prints its parameters
    Check {
        /// The text
        file: PathBuf,
    },
}

/// Prints the id, name and description of each formula, then of each transform.
pub fn list(_arguments: FormulasArguments) -> Result<(), Failure> {
    let transforms = hybrid::step_formulas().filter(|&formula| hybrid::is_transform(formula));
    let all: Vec<_> = formula::all().chain(transforms).collect();
    let width = all.iter().map(|formula| formula.id().len()).max().unwrap_or(0);
    let lines = all.iter().map(|&formula| {
        let step = if hybrid::is_transform(formula) { " (a step of hybrids)" } else { "" };
        format!("{:width$}  {}: {}{step}\n", formula.id(), formula.name(), formula.about())
    });
    print(&lines.collect::<String>())
}

/// Runs `mandelight formula …`.
pub fn run(arguments: FormulaArguments) -> Result<(), Failure> {
    let FormulaCommand::Check { file } = arguments.command;
    let formula = read(&file, own::of_text).map_err(Failure::usage)?;
    let fields = formula.fields().iter().map(|field| format!(" {}", field.name));
    print(&format!("{}: valid; fields:{}\n", visible(formula.name()), fields.collect::<String>()))
}

/// Reads the formula of a text in a file by `parse`: [`own::of_text`], or [`own::alone`] if it is to draw alone.
pub fn read(
    file: &std::path::Path,
    parse: fn(&str) -> Result<FormulaRef, TextError>,
) -> Result<FormulaRef, String> {
    let name = shown(file);
    let length = fs::metadata(file).map_err(|error| format!("{name}: {error}"))?.len();
    let most = formula::language::syntax::MAX_TEXT_BYTES as u64;
    if length > most {
        return Err(format!("{name}: the text has {length} bytes, and a formula may have {most}"));
    }
    let text = fs::read_to_string(file).map_err(|error| format!("{name}: {error}"))?;
    parse(&text).map_err(|error| located(&name, &text, &error))
}

/// The error as compilers show one: the place, the message, the line and a mark below it.
fn located(name: &str, text: &str, error: &TextError) -> String {
    let line = text.lines().nth(error.line - 1).unwrap_or_default().replace('\t', " ");
    let before: String = line.chars().take(error.column - 1).collect();
    let mark = " ".repeat(visible(&before).chars().count());
    let line = visible(&line);
    format!("{name}:{}:{}: {}\n  {line}\n  {mark}^", error.line, error.column, error.message)
}
