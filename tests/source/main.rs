//! The sources and documents: which part may name which, that shaders fit their host, that links lead somewhere,
//! and what workflows may do.

mod direction;
mod documents;
mod layers;
mod shaders;
mod workflows;
