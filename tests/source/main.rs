//! The sources themselves: which part may name which, that the shaders fit their host, and what workflows may do.

mod direction;
mod layers;
mod shaders;
mod workflows;
