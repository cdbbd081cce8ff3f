//! wgpu helpers: device and limits, shader source, asynchronous compilation, readback, timing. Knows no fractals.

pub mod async_compile;
pub mod device;
pub mod readback;
pub mod shader;
pub mod timing;

pub use async_compile::AsyncCompile;
pub use device::{Gpu, GpuError};
