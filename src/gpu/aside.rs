//! Compiling pipelines aside, while everything else goes on: where a platform can, which wgpu
//! itself does not ask for.

use std::sync::{Arc, atomic::AtomicBool};

/// How a platform compiles aside. Both functions are given a device and a closure that asks it
/// for one pipeline.
#[derive(Clone, Copy)]
pub struct Aside {
    /// Starts to compile what the closure asks for, and returns at once. What the closure gets is
    /// of no use. The flag turns true when [`Self::take`] will not have to wait.
    pub begin: fn(&wgpu::Device, &mut dyn FnMut()) -> Arc<AtomicBool>,
    /// Has the closure get what was compiled aside for the same label; where there is nothing, or
    /// that failed, what it asks for.
    pub take: fn(&wgpu::Device, &mut dyn FnMut()),
}
