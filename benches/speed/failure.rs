//! The error of any measurement.

/// An error with a message for people: it ends the run.
pub type Failure = Box<dyn std::error::Error>;
