//! The buffer that sums the films of [sub-frames](super::sub_frame).

use super::{
    buffers::{group, storage},
    layouts::Layouts,
    uniforms::ShutterPixel,
};
use crate::gpu::host_shared::HostShared;

/// The sums of films, and the buffers whose values are averaged with them.
pub struct Shutter {
    sums: wgpu::Buffer,
    averaged: [wgpu::Buffer; 2],
    /// The bind group: sums, moments, guides.
    pub group: wgpu::BindGroup,
}

impl Shutter {
    /// Allocates sums for `pixels`, at least one.
    ///
    /// `averaged`: the noise of pixels and the guides, as in
    /// [`DenoiserSources`](super::denoiser::DenoiserSources).
    pub fn new(layouts: &Layouts, pixels: u64, averaged: [wgpu::Buffer; 2]) -> Self {
        let size = pixels.max(1) * ShutterPixel::SIZE as u64;
        let sums = storage(&layouts.gpu.device, "sub-frames", size);
        let [moments, guides] = averaged.each_ref();
        let bound = [&sums, moments, guides].map(wgpu::Buffer::as_entire_binding);
        let group = group(&layouts.gpu.device, &layouts.shutter, "shutter", bound);
        Self { sums, averaged, group }
    }

    /// Whether there are sums for `pixels`, averaged with these buffers.
    pub fn fits(&self, pixels: u64, averaged: &[wgpu::Buffer; 2]) -> bool {
        self.sums.size() == pixels.max(1) * ShutterPixel::SIZE as u64 && self.averaged == *averaged
    }

    /// GPU memory in bytes.
    pub fn bytes(&self) -> u64 {
        self.sums.size()
    }
}
