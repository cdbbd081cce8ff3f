//! The error of reading a document.

use super::envelope::{MAX_BYTES, VERSION};
use crate::scene::validate::Invalid;

/// Why a document cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DocumentError {
    /// Longer than [`MAX_BYTES`].
    #[error("the document has {bytes} bytes; at most {MAX_BYTES} are read")]
    TooLarge {
        /// Its length.
        bytes: usize,
    },
    /// Not JSON.
    #[error("line {line}, column {column}: {message}")]
    Syntax {
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1; 0 at a line's very start.
        column: usize,
        /// What the JSON reader says.
        message: String,
    },
    /// JSON, but not a scene's.
    #[error("not a Mandelight scene: \"mandelight\": \"scene\" is missing")]
    NotAScene,
    /// A version that this program cannot read.
    #[error("version: {found} cannot be read; this program reads versions 1 to {VERSION}")]
    Version {
        /// The version's JSON.
        found: String,
    },
    /// A field that doesn't exist, or whose value is of the wrong kind.
    #[error("{path}: {message} (line {line}, column {column})")]
    Field {
        /// The field: `lights.environment[2].intensity`.
        path: String,
        /// What is wrong with it.
        message: String,
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1; 0 at a line's very start.
        column: usize,
    },
    /// A value out of range.
    #[error(transparent)]
    Invalid(#[from] Invalid),
}
