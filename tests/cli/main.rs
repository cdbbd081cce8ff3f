//! The command line as a script sees it: exit codes, messages, files.

mod cuts;
mod formulas;
mod frames;
mod gallery;
mod gradients;
mod licenses;
mod looks;
mod messages;
mod pictures;
mod render;
mod stereo;

use std::process::Output;

use mandelight::scene::{Scene, document};
use mandelight_test_support::program::{code, program, said};

/// The built program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_mandelight");

/// What `mandelight scene` answers to arguments.
fn asked(arguments: &[&str]) -> Output {
    program(PROGRAM, ["scene"].iter().chain(arguments)).output().unwrap()
}

/// The scene that `mandelight scene` prints.
fn scene_with(arguments: &[&str]) -> Scene {
    let output = asked(arguments);
    assert_eq!(code(&output), 0, "{}", said(&output));
    document::from_json(&String::from_utf8(output.stdout).unwrap()).unwrap()
}
