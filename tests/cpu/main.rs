//! What needs no GPU: documents and their properties, and the mathematics against oracles.

mod deep;
mod fractal;
mod property;
mod scene;
