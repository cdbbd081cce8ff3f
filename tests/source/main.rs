//! The sources themselves: which part may name which, and that the shaders fit their host.

mod direction;
mod layers;
mod shaders;
