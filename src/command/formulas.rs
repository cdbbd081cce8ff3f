//! `mandelight formulas` and `mandelight formula check`: the formulas, and texts of one's own.

use std::{fs::File, io::Read as _, path::PathBuf};

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
    let most = formula::language::syntax::MAX_TEXT_BYTES;
    let mut bytes = Vec::new();
    // One byte more than the limit shows that there is more.
    File::open(file)
        .and_then(|file| file.take(most as u64 + 1).read_to_end(&mut bytes))
        .map_err(|error| format!("{name}: {error}"))?;
    if bytes.len() > most {
        return Err(format!("{name}: the text has more than {most} bytes, the most that are read"));
    }
    let text = String::from_utf8(bytes).map_err(|_| format!("{name}: this is no text in UTF-8"))?;
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
