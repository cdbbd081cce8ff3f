//! wgpu helpers: device and limits, shader source, readback, timing. Knows no fractals.

pub mod device;
pub mod readback;
pub mod shader;
pub mod timing;

pub use device::{Gpu, GpuError};
