//! Asynchronous pipeline compilation on platforms that have it; wgpu's API has no such call.

use std::sync::{Arc, atomic::AtomicBool};

/// The platform's functions for asynchronous pipeline compilation.
///
/// Both functions get a device and a closure that creates one pipeline on the device.
#[derive(Clone, Copy)]
pub struct AsyncCompile {
    /// Starts to compile the closure's pipeline, and returns at once.
    ///
    /// The pipeline that the closure creates is a placeholder. The flag turns true when
    /// [`Self::take`] no longer blocks.
    pub begin: fn(&wgpu::Device, &mut dyn FnMut()) -> Arc<AtomicBool>,
    /// Hands the pipeline compiled for the same label to the closure.
    ///
    /// Compiles the pipeline now if [`Self::begin`] was not called or failed.
    pub take: fn(&wgpu::Device, &mut dyn FnMut()),
    /// Most pipelines that are compiled at once while pictures are drawn without them, for all views; at least 1.
    pub at_once: usize,
}
