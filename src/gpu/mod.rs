//! wgpu helpers: device and limits, shader source, pipelines made aside, readback, timing. Knows no fractals.

pub mod aside;
pub mod device;
pub mod readback;
pub mod shader;
pub mod timing;

pub use aside::Aside;
pub use device::{Gpu, GpuError};
