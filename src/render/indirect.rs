//! The source of indirect light: centre samples of the whole picture.
//!
//! In: the centre samples of the whole picture, with their direct light. Out: bindings for the
//! indirect pass. A view of a whole picture is its own source; a view of a tile borrows the source of a
//! view of the whole picture ([`View::lend_indirect_source`](super::View::lend_indirect_source)), so
//! that neighbours beyond the tile's border count.

use super::{
    buffers,
    environment_texture::EnvironmentTexture,
    layouts::Layouts,
    targets::{GBuffer, Targets},
};

/// Centre samples of a whole picture. Clones share the buffers.
#[derive(Clone)]
pub struct IndirectSource {
    /// Size of one eye's picture in pixels.
    pub eye_px: [u32; 2],
    /// The samples' surface, packed as [`GBuffer::surface`].
    pub surface: wgpu::Buffer,
    /// The samples' direct light, packed as [`Targets::direct`].
    pub direct: wgpu::Buffer,
}

impl IndirectSource {
    /// The centre samples of `targets`; `eye_px` is the size of one eye's picture.
    pub fn of(targets: &Targets, eye_px: [u32; 2]) -> Self {
        let (surface, direct) = (targets.center.surface.clone(), targets.direct.clone());
        Self { eye_px, surface, direct }
    }
}

/// The bind groups 1 to 3 of the indirect pass.
pub fn groups(
    layouts: &Layouts,
    targets: &Targets,
    samples: &GBuffer,
    source: &IndirectSource,
) -> [wgpu::BindGroup; 3] {
    let device = &layouts.gpu.device;
    let EnvironmentTexture { view, sampler, .. } = &*targets.environment_texture;
    let samples = [&samples.surface, &samples.color_data, &samples.visibility]
        .map(wgpu::Buffer::as_entire_binding);
    let read = [
        wgpu::BindingResource::TextureView(view),
        wgpu::BindingResource::Sampler(sampler),
        source.surface.as_entire_binding(),
    ];
    [
        buffers::group(device, &layouts.samples, "samples", samples),
        targets.film_with(layouts, &source.direct),
        buffers::group(device, &layouts.indirect, "indirect source", read),
    ]
}
