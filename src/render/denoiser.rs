//! Buffers of the denoiser.

use super::{
    buffers::{group, storage},
    layouts::Layouts,
};

/// Buffers that the denoiser reads and does not own.
#[derive(Clone, PartialEq)]
pub struct DenoiserSources {
    /// The noise of pixels: see `shaders/types/traced_paths.wgsl`.
    pub moments: wgpu::Buffer,
    /// Albedo and normal of pixels: see `shaders/types/guides.wgsl`.
    pub guides: wgpu::Buffer,
    /// Depths of the centre samples.
    pub surface: wgpu::Buffer,
}

/// Light before and after an iteration of the denoiser, 4 bytes a pixel each.
pub struct Denoiser {
    sources: DenoiserSources,
    light: [wgpu::Buffer; 2],
    /// Bound by the pass that makes the input: moments, guides, light.
    pub input_group: wgpu::BindGroup,
    /// Bound by the iterations: guides, depths, light before and after even iterations.
    pub group: wgpu::BindGroup,
    /// Bound by tone mapping: the denoised light.
    pub output_group: wgpu::BindGroup,
}

impl Denoiser {
    /// Allocates light of `pixels`; of one if there are none to denoise.
    pub fn new(layouts: &Layouts, pixels: u64, sources: DenoiserSources) -> Self {
        let device = &layouts.gpu.device;
        let light =
            ["light", "smoother light"].map(|label| storage(device, label, 4 * pixels.max(1)));
        let [even, odd] = light.each_ref().map(wgpu::Buffer::as_entire_binding);
        let DenoiserSources { moments, guides, surface } = &sources;
        let [moments, guides, surface] =
            [moments, guides, surface].map(wgpu::Buffer::as_entire_binding);
        Self {
            input_group: group(
                device,
                &layouts.denoise_input,
                "denoise input",
                [moments, guides.clone(), even.clone()],
            ),
            output_group: group(device, &layouts.denoised, "denoised", [odd.clone()]),
            group: group(device, &layouts.denoise, "denoise", [guides, surface, even, odd]),
            light,
            sources,
        }
    }

    /// Whether the denoiser holds `pixels` of light from `sources`.
    pub fn fits(&self, pixels: u64, sources: &DenoiserSources) -> bool {
        self.light[0].size() == 4 * pixels.max(1) && self.sources == *sources
    }

    /// The denoised light: shared exponents, as in `shaders/lib/shared_exponent.wgsl`.
    pub fn output(&self) -> &wgpu::Buffer {
        &self.light[1]
    }

    /// GPU memory in bytes.
    pub fn bytes(&self) -> u64 {
        self.light.iter().map(wgpu::Buffer::size).sum()
    }
}
