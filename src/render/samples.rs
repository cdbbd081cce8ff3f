//! Reads back the pixels of a view: radiance, depth and normal.
//!
//! In: a view's film and G-buffer. Out: every pixel's radiance, depth and normal, once all buffers have
//! arrived; no call blocks.

use glam::Vec3;

use super::gbuffer::Samples;
use crate::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
};

/// One pixel of a finished picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Mean radiance of its samples, linear Rec. 709.
    pub radiance: [f32; 3],
    /// Depth of the centre sample along its unit ray, in scene units; 0 on a miss.
    pub depth: f32,
    /// The centre sample's unit normal in world space; undefined where the depth is 0.
    pub normal: Vec3,
}

/// A pending readback of a view's buffers.
pub struct SamplesReadback {
    film: [Arrival; 2],
    surface: Arrival,
    scale: f64,
}

/// A buffer in readback.
enum Arrival {
    Awaited(Readback),
    There(Vec<u8>),
}

impl Arrival {
    /// The bytes, if they have arrived.
    fn look(&mut self, gpu: &Gpu) -> Result<Option<&[u8]>, ReadbackError> {
        if let Self::Awaited(readback) = self
            && let Some(bytes) = readback.take(gpu)?
        {
            *self = Self::There(bytes);
        }
        Ok(match self {
            Self::Awaited(_) => None,
            Self::There(bytes) => Some(bytes),
        })
    }
}

impl SamplesReadback {
    /// Starts to read back the film's two halves, and the centre samples' depths and normals.
    ///
    /// Depths are in units of `scale` scene units.
    pub fn new(gpu: &Gpu, film: [&wgpu::Buffer; 2], surface: &wgpu::Buffer, scale: f64) -> Self {
        let read = |buffer| Arrival::Awaited(Readback::buffer(gpu, buffer));
        Self { film: film.map(read), surface: read(surface), scale }
    }

    /// Every pixel, rows from the top, once all buffers have arrived; none before.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn take(&mut self, gpu: &Gpu) -> Result<Option<Vec<PixelSample>>, ReadbackError> {
        let Self { film: [rg, bw], surface, scale } = self;
        let all = [rg.look(gpu)?, bw.look(gpu)?, surface.look(gpu)?];
        let [Some(rg), Some(bw), Some(surface)] = all else { return Ok(None) };
        let surface = Samples::decode(surface, &[], *scale);
        let points = surface.depth.into_iter().zip(surface.normal);
        let pixels = means(rg, bw).zip(points);
        Ok(Some(
            pixels
                .map(|(radiance, (depth, normal))| PixelSample { radiance, depth, normal })
                .collect(),
        ))
    }
}

/// Each pixel's mean radiance, from the bytes of the film's two halves.
pub fn means<'a>(rg: &'a [u8], bw: &'a [u8]) -> impl Iterator<Item = [f32; 3]> + 'a {
    let pairs = |bytes: &'a [u8]| bytes.as_chunks::<8>().0.iter().map(|p| bytemuck::cast(*p));
    pairs(rg).zip(pairs(bw)).map(|([r, g], [b, samples]): ([f32; 2], [f32; 2])| {
        [r, g, b].map(|sum| sum / samples.max(1.0))
    })
}
