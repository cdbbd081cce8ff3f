//! Asynchronous pipeline compilation, where the platform has it: wgpu itself has no call for it.

use std::sync::{Arc, atomic::AtomicBool};

/// The platform's asynchronous compilation. Both functions get a device and a closure that asks the device
/// for one pipeline.
#[derive(Clone, Copy)]
pub struct AsyncCompile {
    /// Starts to compile what the closure asks for, and returns at once. What the closure gets is
    /// of no use. The flag turns true when [`Self::take`] will not have to wait.
    pub begin: fn(&wgpu::Device, &mut dyn FnMut()) -> Arc<AtomicBool>,
    /// Gives the closure the pipeline that was compiled for the same label; compiles it now where there is
    /// none or compilation failed.
    pub take: fn(&wgpu::Device, &mut dyn FnMut()),
}
