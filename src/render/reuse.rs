//! Moves samples from the buffers of one width to those of another.

use super::{region::Overlap, targets::Targets};
use crate::gpu::Gpu;

/// The buffers of a picture, and the width of its rows.
#[derive(Clone, Copy)]
pub struct Film<'a> {
    /// The buffers.
    pub targets: &'a Targets,
    /// Width in pixels.
    pub width_px: u32,
}

impl<'a> Film<'a> {
    /// All buffers of samples that outlive a piece of work, with the bytes of a pixel, in one order.
    fn buffers(self) -> [(&'a wgpu::Buffer, u64); 7] {
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

    /// Number of pixels.
    fn pixels(self) -> u64 {
        self.targets.film_rg.size() / 8
    }

    /// Index of a pixel, row by row.
    fn index(self, [x, y]: [u32; 2]) -> u64 {
        u64::from(y) * u64::from(self.width_px) + u64::from(x)
    }
}

/// Copies the samples of the pixels that `new` shares with `old`, and the counts of light paths.
///
/// Both have to be of one scene.
pub fn copy_samples(gpu: &Gpu, old: Film<'_>, new: Film<'_>, overlap: &Overlap) {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let [columns, rows] = overlap.size_px;
    for ((from, bytes), (to, _)) in old.buffers().into_iter().zip(new.buffers()) {
        let is_whole =
            [(from, old), (to, new)].map(|(it, film)| it.size() == bytes * film.pixels());
        // The scene does without this buffer.
        if is_whole != [true; 2] {
            continue;
        }
        for row in 0..rows {
            let at = |[x, y]: [u32; 2]| [x, y + row];
            let source = bytes * old.index(at(overlap.first_in_old));
            let target = bytes * new.index(at(overlap.first));
            encoder.copy_buffer_to_buffer(from, source, to, target, bytes * u64::from(columns));
        }
    }
    let counts = [old, new].map(|film| &film.targets.paths.counts);
    encoder.copy_buffer_to_buffer(counts[0], 0, counts[1], 0, counts[1].size());
    gpu.queue.submit([encoder.finish()]);
}
