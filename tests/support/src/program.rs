//! The built program, run as a script runs it: exit codes, messages, files.

use std::{
    ffi::OsStr,
    fs,
    io::Write,
    path::Path,
    process::{Command, Output, Stdio},
};

/// A call of the program at `path`, with nothing on its standard streams and no desktop about it.
pub fn program<S: AsRef<OsStr>>(path: &str, arguments: impl IntoIterator<Item = S>) -> Command {
    let mut command = Command::new(path);
    command.args(arguments).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    // Mesa's device selection complains on standard error where this is not set.
    command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    command
}

/// Runs a program to its end with `input` on its standard input.
pub fn run_with_input(mut command: Command, input: &[u8]) -> Output {
    let mut child = command.stdin(Stdio::piped()).spawn().expect("the program starts");
    // A program that refuses its arguments does not read.
    let _ = child.stdin.take().expect("its standard input").write_all(input);
    child.wait_with_output().expect("the program's end")
}

/// The exit code.
pub fn code(output: &Output) -> i32 {
    output.status.code().expect("ended by itself")
}

/// What stands on standard error; never a panic.
pub fn said(output: &Output) -> String {
    let text = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert!(!text.contains("panicked"), "{text}");
    text
}

/// The names of a folder's files, sorted.
pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in UTF-8"))
        .collect();
    names.sort();
    names
}
