//! Documents: every parameter's range, paths, the opening scenes and the dives; tone curves.

mod dives;
mod document;
mod follow;
mod gallery;
mod limits;
mod looks;
mod path_document;
mod presets;
mod tone;
mod versions;
