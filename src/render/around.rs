//! Where indirect light comes from: the neighbours of a sample on the screen.
//!
//! In: the centre samples of all of the picture, with their direct light. Out: bindings for the
//! gather pass. A view is its own neighbourhood; one that draws a tile borrows that of a view
//! that draws the whole picture ([`View::lend_neighbours`](super::View::lend_neighbours)), so
//! that no tile ends at its border.

use super::{
    backdrop::Backdrop,
    kernels::Kernels,
    targets::{self, GBuffer, Targets},
};

/// Centre samples of a whole picture. Clones share the buffers.
#[derive(Clone)]
pub struct Neighbours {
    /// One eye's picture, pixels.
    pub eye_px: [u32; 2],
    /// As [`GBuffer::surface`].
    pub surface: wgpu::Buffer,
    /// As [`Targets::direct`].
    pub direct: wgpu::Buffer,
}

/// Groups 1 to 3 of the gather pass.
pub fn groups(
    kernels: &Kernels,
    targets: &Targets,
    samples: &GBuffer,
    neighbours: &Neighbours,
) -> [wgpu::BindGroup; 3] {
    let device = &kernels.gpu.device;
    let layouts = &kernels.layouts;
    let Backdrop { view, sampler, .. } = &*targets.backdrop;
    let samples = [&samples.surface, &samples.color_data, &samples.visibility]
        .map(wgpu::Buffer::as_entire_binding);
    let around = [
        wgpu::BindingResource::TextureView(view),
        wgpu::BindingResource::Sampler(sampler),
        neighbours.surface.as_entire_binding(),
    ];
    [
        targets::group(device, &layouts.samples, "samples", samples),
        targets.film_with(kernels, &neighbours.direct),
        targets::group(device, &layouts.around, "neighbours", around),
    ]
}
