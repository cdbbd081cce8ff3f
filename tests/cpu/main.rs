//! What needs no GPU: documents and their properties, the mathematics against oracles, and how the
//! tests compare pictures.

mod compare;
mod deep;
mod fractal;
mod language;
mod places;
mod property;
mod scene;
