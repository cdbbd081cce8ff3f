//! The pipelines of the passes that see the film as a whole.

use super::pass;
use crate::gpu::shader::Module;

/// The passes that see the film as a whole.
pub struct PostPipelines {
    /// Film to the finest mip level.
    pub mean: wgpu::ComputePipeline,
    /// A mip level to the next.
    pub reduce: wgpu::ComputePipeline,
    /// Mean to exposure.
    pub expose: wgpu::ComputePipeline,
    /// Film to histogram.
    pub histogram: wgpu::ComputePipeline,
    /// What blooms, to the finest mip level.
    pub bloom: wgpu::ComputePipeline,
    /// One direction of a blur.
    pub blur: wgpu::ComputePipeline,
}

impl PostPipelines {
    /// Their names and modules, in the order of the fields.
    pub(super) const PARTS: [&Module; 6] = [
        &pass::mean::MODULE,
        &pass::reduce::MODULE,
        &pass::expose::MODULE,
        &pass::histogram::MODULE,
        &pass::bloom::MODULE,
        &pass::blur::MODULE,
    ];

    /// All of them, made by `part` from their places in [`Self::PARTS`].
    pub(super) fn from_parts(mut part: impl FnMut(usize) -> wgpu::ComputePipeline) -> Self {
        Self {
            mean: part(0),
            reduce: part(1),
            expose: part(2),
            histogram: part(3),
            bloom: part(4),
            blur: part(5),
        }
    }
}
