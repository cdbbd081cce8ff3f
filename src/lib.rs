//! Mandelight draws 3D fractals: as a page in the browser and without a window on any wgpu adapter.

pub mod export;
pub mod fractal;
pub mod gpu;
pub mod render;
pub mod scene;
pub mod ui;
#[cfg(target_arch = "wasm32")]
mod web;
