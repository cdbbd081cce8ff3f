//! Moves samples from the buffers of one size to those of another.

use super::{region::Overlap, targets::Targets};
use crate::gpu::Gpu;

/// The targets of a picture.
#[derive(Clone, Copy)]
pub struct Sized<'a> {
    /// The buffers.
    pub targets: &'a Targets,
    /// Width of the film, pixels.
    pub width_px: u32,
}

impl<'a> Sized<'a> {
    /// All buffers of samples that stay between two pieces of work, with the bytes of a pixel, in one order.
    ///
    /// Light paths have some of them; without paths these hold a few bytes.
    fn samples(self) -> [(&'a wgpu::Buffer, u64); 7] {
        let Targets { center, film_rg, film_bw, direct, paths, .. } = self.targets;
        [
            (&center.surface, 8),
            (&center.color_data, 8),
            (&center.visibility, 8),
            (film_rg, 8),
            (film_bw, 8),
            (direct, 4),
            (&paths.moments, 4),
        ]
    }

    /// Number of a pixel, row by row.
    fn index(self, [x, y]: [u32; 2]) -> u64 {
        u64::from(y) * u64::from(self.width_px) + u64::from(x)
    }
}

/// Copies the samples of the pixels that both have, `overlap` of `to` with `from`.
///
/// The buffers of both have to be those of the same scene.
pub fn copy_samples(gpu: &Gpu, from: Sized<'_>, to: Sized<'_>, overlap: &Overlap) {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let [columns, rows] = overlap.size_px;
    for ((old, bytes), (new, _)) in from.samples().into_iter().zip(to.samples()) {
        // Buffers that the scene does not need are of one pixel.
        if old.size() == bytes || new.size() == bytes {
            continue;
        }
        for row in 0..rows {
            let at = |[x, y]: [u32; 2]| [x, y + row];
            let source = bytes * from.index(at(overlap.first_in_other));
            let target = bytes * to.index(at(overlap.first));
            encoder.copy_buffer_to_buffer(old, source, new, target, bytes * u64::from(columns));
        }
    }
    let (old, new) = (&from.targets.paths.counts, &to.targets.paths.counts);
    encoder.copy_buffer_to_buffer(old, 0, new, 0, new.size());
    gpu.queue.submit([encoder.finish()]);
}
