//! `mandelight --licenses`: the licences of what this program contains.

use super::{Failure, print};

/// The text that `cargo xtask notices` writes.
const TEXT: &str = include_str!("../../THIRD-PARTY-LICENSES.txt");

/// Prints the text.
pub fn run() -> Result<(), Failure> {
    print(TEXT)
}
