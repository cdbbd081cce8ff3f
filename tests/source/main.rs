//! The sources and documents: which part may name which, that shaders fit their host, that links lead somewhere,
//! what workflows may do, and what packages of Node.js are taken.

mod direction;
mod documents;
mod layers;
mod packages;
mod shaders;
mod workflows;
