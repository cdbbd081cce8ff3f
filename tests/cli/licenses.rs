//! `--licenses`: what it prints, and what a call without a command says.

use mandelight_test_support::program::{code, program, said};

use super::PROGRAM;

#[test]
fn licenses_are_those_of_the_file() {
    let output = program(PROGRAM, ["--licenses"]).output().unwrap();
    assert_eq!((code(&output), said(&output)), (0, String::new()));
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/THIRD-PARTY-LICENSES.txt");
    assert!(output.stdout == std::fs::read(file).unwrap());
    let manual = include_str!("../../docs/command-line.md");
    assert!(manual.contains("## `mandelight --licenses`"));
}

#[test]
fn a_call_without_a_command_fails_and_names_the_help() {
    for arguments in [&[][..], &["--"]] {
        let output = program(PROGRAM, arguments).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(said(&output).contains("--help"), "{arguments:?}: {}", said(&output));
    }
    let output = program(PROGRAM, ["--licenses", "info"]).output().unwrap();
    assert_eq!(code(&output), 2, "{}", said(&output));
}
