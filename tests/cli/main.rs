//! The command line as a script sees it: exit codes, messages, files.

mod cuts;
mod formulas;
mod frames;
mod gallery;
mod gradients;
mod looks;
mod messages;
mod pictures;
mod render;
mod stereo;

/// The built program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_mandelight");
