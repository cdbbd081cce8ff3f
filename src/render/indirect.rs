//! The source of indirect light: centre samples of the whole picture.
//!
//! In: the centre samples of all of the picture, with their direct light. Out: bindings for the
//! indirect pass. A view is its own neighbourhood; one that draws a tile borrows that of a view
//! that draws the whole picture ([`View::lend_indirect_source`](super::View::lend_indirect_source)), so
//! that no tile ends at its border.

use super::{
    environment_texture::EnvironmentTexture,
    pipelines::Pipelines,
    targets::{self, GBuffer, Targets},
};

/// Centre samples of a whole picture. Clones share the buffers.
#[derive(Clone)]
pub struct IndirectSource {
    /// One eye's picture, pixels.
    pub eye_px: [u32; 2],
    /// As [`GBuffer::surface`].
    pub surface: wgpu::Buffer,
    /// As [`Targets::direct`].
    pub direct: wgpu::Buffer,
}

/// Groups 1 to 3 of the indirect pass.
pub fn groups(
    pipelines: &Pipelines,
    targets: &Targets,
    samples: &GBuffer,
    source: &IndirectSource,
) -> [wgpu::BindGroup; 3] {
    let device = &pipelines.gpu.device;
    let layouts = &pipelines.layouts;
    let EnvironmentTexture { view, sampler, .. } = &*targets.environment_texture;
    let samples = [&samples.surface, &samples.color_data, &samples.visibility]
        .map(wgpu::Buffer::as_entire_binding);
    let read = [
        wgpu::BindingResource::TextureView(view),
        wgpu::BindingResource::Sampler(sampler),
        source.surface.as_entire_binding(),
    ];
    [
        targets::group(device, &layouts.samples, "samples", samples),
        targets.film_with(pipelines, &source.direct),
        targets::group(device, &layouts.indirect, "indirect source", read),
    ]
}
