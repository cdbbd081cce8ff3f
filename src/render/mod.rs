//! How a picture is made: see `frame.rs` for the passes in the order in which they run.

pub mod report;

use std::sync::Arc;

use crate::{gpu::Gpu, scene::Scene};
pub use report::{Activity, Report};

/// The compute pipelines of one device, shared by every view on it.
pub struct Kernels {
    /// The device.
    pub gpu: Gpu,
}

impl Kernels {
    /// Makes the pipelines that every picture needs.
    pub fn new(_gpu: &Gpu) -> Arc<Self> {
        unimplemented!()
    }
}

/// A rectangle of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// The whole picture, width and height in pixels.
    pub picture_px: [u32; 2],
    /// The rectangle's upper left corner in it.
    pub origin_px: [u32; 2],
    /// The rectangle's width and height; both at least 1, at most [`MAX_REGION_PX`] each.
    pub size_px: [u32; 2],
}

/// Largest width or height of one region (WebGPU's default texture limit).
pub const MAX_REGION_PX: u32 = 8192;

impl Region {
    /// The region that is the whole picture.
    pub fn whole(size_px: [u32; 2]) -> Self {
        Self { picture_px: size_px, origin_px: [0, 0], size_px }
    }
}

/// How a view spends GPU time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Someone is watching: sparse lattices while things change, small slices.
    Interactive,
    /// A still: straight to all samples, larger slices.
    Still,
}

/// One picture in progress: its buffers and its schedule.
pub struct View {}

impl View {
    /// Allocates the buffers of `region`.
    pub fn new(_kernels: &Arc<Kernels>, _region: Region, _pace: Pace) -> Self {
        unimplemented!()
    }

    /// The rectangle that is drawn.
    pub fn region(&self) -> Region {
        unimplemented!()
    }

    /// Gives the view another rectangle; buffers are made again where its size differs.
    pub fn set_region(&mut self, _region: Region) {
        unimplemented!()
    }

    /// Gives the view its scene. Only what changed becomes stale. `moving` says that more
    /// changes are expected at once (a drag, a flight): the view then stays on a sparse lattice.
    pub fn set_scene(&mut self, _scene: &Scene, _moving: bool) {
        unimplemented!()
    }

    /// Submits as much work as fits now, without waiting. Call it once per displayed frame, or,
    /// for a still, in a loop with a device poll. `now_secs` is any steady clock. Returns true
    /// while there is more to do.
    pub fn pump(&mut self, _now_secs: f64) -> bool {
        unimplemented!()
    }

    /// What the view is doing.
    pub fn report(&self) -> Report {
        unimplemented!()
    }

    /// The display picture: `Rgba8Unorm`, sRGB-encoded, opaque, `region().size_px` large;
    /// usages TEXTURE_BINDING | COPY_SRC. A new texture comes with every change of size
    /// ([`Self::texture_generation`] counts them). It holds a complete picture at all times
    /// after the first one: never a half-filled lattice.
    pub fn texture(&self) -> &wgpu::Texture {
        unimplemented!()
    }

    /// How many textures there have been.
    pub fn texture_generation(&self) -> u64 {
        unimplemented!()
    }
}
