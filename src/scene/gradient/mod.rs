//! Gradients with names: those that come with the program, and those of files.
//!
//! In: a file of another program. Out: stops, at most [`MAX_GRADIENT_STOPS`](super::MAX_GRADIENT_STOPS), in linear light.

mod file;
mod fit;
mod library;
mod named;

pub use file::{ENDINGS, GradientFileError, MAX_FILE_BYTES, read};
pub use library::library;
pub use named::NamedGradient;
