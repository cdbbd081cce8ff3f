//! The adapter and the device, always with WebGPU's default limits.

use std::sync::Arc;

/// Why there is no usable GPU.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter was offered.
    #[error("no GPU adapter was found: install a Vulkan driver (Mesa's lavapipe will do), or use a browser with WebGPU")]
    NoAdapter(String),
    /// The adapter refused a device with default limits.
    #[error("the adapter {adapter} gave no device: {reason}")]
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What wgpu said.
        reason: String,
    },
}

/// A device, its queue and what they came from. Clones share the same device.
#[derive(Clone)]
pub struct Gpu {
    /// For eframe's `WgpuSetup::Existing`.
    pub instance: wgpu::Instance,
    /// Where the device came from.
    pub adapter: wgpu::Adapter,
    /// The device, with default limits.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens the first adapter that offers a device with default limits.
    /// On the web `surface_canvas` compatibility isn't needed: WebGPU adapters present anywhere.
    pub async fn open() -> Result<Self, GpuError> {
        unimplemented!()
    }

    /// The adapter's name and backend, for people: `"llvmpipe (LLVM 15) · Vulkan"`.
    pub fn name(&self) -> String {
        unimplemented!()
    }
}

/// Shared handle used across layers.
pub type SharedGpu = Arc<Gpu>;
