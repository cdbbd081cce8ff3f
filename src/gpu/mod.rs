//! wgpu helpers: device and limits, shader source, readback, timing. Knows no fractals.

pub mod device;

pub use device::{Gpu, GpuError};
