//! `src/fractal` by its properties, and against the oracle in f64.

mod marching;
mod normals;
mod oracle;
mod properties;
