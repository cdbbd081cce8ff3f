//! What the readers of everything from outside promise, whatever the bytes.
//!
//! In: bytes. Out: whether they are read or refused; a broken promise panics. The ordinary tests, the
//! tests of 32 bits and the coverage-guided fuzzer of `fuzz/` call the same functions.
//!
//! | module | contents |
//! |---|---|
//! | one of each target | what its reader promises, and bytes to start from |
//! | `promises` | what several targets promise |
//! | `mutate` | changes that keep the form of a format |
//! | `meter` | the memory and work of a call |

pub mod meter;
mod mutate;
mod promises;

#[path = "../../../src/command/mod.rs"]
pub mod command;

mod command_line;
mod document;
mod formula;
mod gallery;
mod gradient;
mod jpeg;
mod link;
mod openexr;
mod png;
mod radiance;
mod webp;

pub use command_line::long_arguments;
pub use mutate::{InputFormat, mutated};
pub use openexr::COMPRESSIONS as OPENEXR_COMPRESSIONS;

/// Whether bytes are read or refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The bytes are read.
    Read,
    /// The bytes are refused, with a message.
    Refused,
}

/// A reader under test.
pub struct FuzzTarget {
    /// The name, also of the folder of its corpus.
    pub name: &'static str,
    /// Reads bytes, and panics where a promise is broken.
    pub check: fn(&[u8]) -> Outcome,
    /// Bytes that are read, to start from.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// The format that changes keep.
    pub format: InputFormat,
    /// Inputs of the ordinary tests, in hundreds: more for what is read more often or costs less.
    pub hundreds: usize,
    /// Most bytes that are allocated in all for any input: a measure of work.
    pub most_work: usize,
}

/// Largest input that is made, in bytes. Files at their limits are the tests of `tests/reading`.
pub const MAX_INPUT_BYTES: usize = 64 << 10;

/// Every target.
pub const TARGETS: [FuzzTarget; 11] = [
    document::TARGET,
    link::TARGET,
    formula::TARGET,
    png::TARGET,
    jpeg::TARGET,
    webp::TARGET,
    openexr::TARGET,
    radiance::TARGET,
    gradient::TARGET,
    gallery::TARGET,
    command_line::TARGET,
];

/// The target of this name.
///
/// # Panics
/// If there is none.
pub fn target(name: &str) -> &'static FuzzTarget {
    static ALL: [FuzzTarget; 11] = TARGETS;
    ALL.iter().find(|target| target.name == name).expect("a target of this name")
}
