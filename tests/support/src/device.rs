//! Devices for tests: one for all tests of a binary, and fresh ones where a test counts what a
//! device does.

use std::sync::{Arc, LazyLock};

use mandelight::{gpu::Gpu, render::Pipelines};

/// A device of its own on whatever adapter the platform prefers; Mesa's lavapipe will do.
pub fn fresh_gpu() -> Gpu {
    pollster::block_on(Gpu::open(None)).expect("a GPU or a software driver")
}

/// Pipelines on a device of their own, of which nothing else compiled any.
pub fn fresh_pipelines() -> Arc<Pipelines> {
    Pipelines::new(&fresh_gpu())
}

/// The pipelines of the one device that the tests of a binary share.
pub fn pipelines() -> &'static Arc<Pipelines> {
    static PIPELINES: LazyLock<Arc<Pipelines>> = LazyLock::new(fresh_pipelines);
    &PIPELINES
}

/// The device that the tests of a binary share.
pub fn gpu() -> &'static Gpu {
    &pipelines().gpu
}
