//! Execution of other programs. In: a command. Out: success, or an error with the command line.

use std::{
    path::PathBuf,
    process::{Command, Stdio},
};

use anyhow::{Context as _, Result, bail};

/// The repository's top folder.
///
/// The path is read at run time, so that a moved checkout needs no rebuild.
pub fn root() -> Result<PathBuf> {
    let xtask = std::env::var_os("CARGO_MANIFEST_DIR").context("start this as `cargo xtask`")?;
    let root = PathBuf::from(xtask).join("..");
    root.canonicalize().with_context(|| format!("no folder {}", root.display()))
}

/// Cargo's output folder: `CARGO_TARGET_DIR` or `target/`.
pub fn target() -> Result<PathBuf> {
    Ok(match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => root()?.join(folder),
        None => root()?.join("target"),
    })
}

/// A command of the cargo that runs this program, in the top folder.
pub fn cargo() -> Result<Command> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root()?);
    Ok(cargo)
}

/// Builds the command line program and returns its path.
pub fn renderer() -> Result<PathBuf> {
    run(cargo()?.args(["build", "--release", "--bin", "mandelight"]))?;
    Ok(target()?.join("release").join(format!("mandelight{}", std::env::consts::EXE_SUFFIX)))
}

/// Runs `command` with its output on the terminal; anything but exit code 0 is an error.
pub fn run(command: &mut Command) -> Result<()> {
    let line = line_of(command);
    eprintln!("$ {line}");
    let status = command.status().with_context(|| format!("could not start `{line}`"))?;
    if !status.success() {
        bail!("`{line}` failed ({status})");
    }
    Ok(())
}

/// Runs `command` silently; its standard output, or none if the command failed.
pub fn output(command: &mut Command) -> Option<String> {
    let done = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    done.status.success().then(|| String::from_utf8_lossy(&done.stdout).trim().to_owned())
}

/// The command line as typed, without the program's folder.
fn line_of(command: &Command) -> String {
    let program = PathBuf::from(command.get_program());
    let program = program.file_name().unwrap_or(command.get_program()).to_string_lossy();
    let words = command.get_args().map(|word| word.to_string_lossy());
    std::iter::once(program).chain(words).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_failing_command_shows_its_command_line() {
        let error = run(Command::new("cargo").arg("no-such-subcommand")).unwrap_err();
        assert!(error.to_string().contains("cargo no-such-subcommand"), "{error}");
    }

    #[test]
    fn a_missing_program_gives_no_output() {
        assert_eq!(output(&mut Command::new("a-program-that-is-not-there")), None);
    }
}
