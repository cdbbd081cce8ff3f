//! pending

pub mod navigation;
