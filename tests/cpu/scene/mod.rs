//! Documents: every parameter's range, paths, the opening scenes and the dives.

mod dives;
mod document;
mod follow;
mod gallery;
mod limits;
mod path_document;
mod presets;
mod versions;
