//! wgpu helpers: device, shader source, asynchronous compilation, readback and timing.
//!
//! This layer does not depend on fractals or scenes.

pub mod async_compile;
pub mod device;
pub mod host_shared;
pub mod readback;
pub mod shader;
pub mod timing;

pub use async_compile::AsyncCompile;
pub use device::{Cpu, Gpu, GpuError};
