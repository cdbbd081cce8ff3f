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
    /// Guides for denoisers; none without path tracing.
    pub guides: Option<Guides>,
}

/// Guides for denoisers: means over the first vertices of a pixel's paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guides {
    /// Albedo, linear Rec. 709; 1 in the background.
    pub albedo: [f32; 3],
    /// Normal in world space; 0 in the background, shorter than 1 where normals differ.
    pub normal: Vec3,
}

impl Guides {
    /// The guides of all pixels, from the bytes of `shaders/types/guides.wgsl`.
    pub fn decode(bytes: &[u8]) -> impl Iterator<Item = Self> + '_ {
        let signed = |byte: u8| (f32::from(byte as i8) / 127.0).max(-1.0);
        bytes.as_chunks::<8>().0.iter().map(move |&[r, g, b, _, x, y, z, _]| Self {
            albedo: [r, g, b].map(|byte| f32::from(byte) / 255.0),
            normal: Vec3::new(signed(x), signed(y), signed(z)),
        })
    }
}

/// The light of a view's pixels, as its buffers hold it.
pub enum Light<'a> {
    /// The film's two halves.
    Film([&'a wgpu::Buffer; 2]),
    /// Denoised light, in shared exponents.
    Denoised(&'a wgpu::Buffer),
}

/// A pending readback of a view's buffers.
pub struct SamplesReadback {
    /// The film's halves, or denoised light.
    light: Vec<Arrival>,
    surface: Arrival,
    guides: Option<Arrival>,
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
    /// Starts to read back the light, the centre samples' depths and normals, and guides for denoisers.
    ///
    /// Depths are in units of `scale` scene units.
    pub fn new(
        gpu: &Gpu,
        light: Light<'_>,
        surface: &wgpu::Buffer,
        guides: Option<&wgpu::Buffer>,
        scale: f64,
    ) -> Self {
        let read = |buffer| Arrival::Awaited(Readback::buffer(gpu, buffer));
        let light = match light {
            Light::Film(halves) => halves.map(read).into(),
            Light::Denoised(buffer) => vec![read(buffer)],
        };
        Self { light, surface: read(surface), guides: guides.map(read), scale }
    }

    /// Every pixel, rows from the top, once all buffers have arrived; none before.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn take(&mut self, gpu: &Gpu) -> Result<Option<Vec<PixelSample>>, ReadbackError> {
        let mut light = Vec::new();
        for arrival in &mut self.light {
            let Some(bytes) = arrival.look(gpu)? else { return Ok(None) };
            light.push(bytes);
        }
        let Some(surface) = self.surface.look(gpu)? else { return Ok(None) };
        let guides: Vec<Guides> = match &mut self.guides {
            None => Vec::new(),
            Some(arrival) => {
                let Some(bytes) = arrival.look(gpu)? else { return Ok(None) };
                Guides::decode(bytes).collect()
            }
        };
        let surface = Samples::decode(surface, &[], self.scale);
        let points = surface.depth.into_iter().zip(surface.normal).enumerate();
        let pixel = |(radiance, (i, (depth, normal)))| PixelSample {
            radiance,
            depth,
            normal,
            guides: guides.get(i).copied(),
        };
        Ok(Some(match light[..] {
            [rg, bw] => means(rg, bw).zip(points).map(pixel).collect(),
            [packed, ..] => denoised(packed).zip(points).map(pixel).collect(),
            [] => Vec::new(),
        }))
    }
}

/// Each pixel's radiance, from the bytes of denoised light: see `shaders/lib/shared_exponent.wgsl`.
pub fn denoised(packed: &[u8]) -> impl Iterator<Item = [f32; 3]> + '_ {
    packed.as_chunks::<4>().0.iter().map(|bytes| {
        let bits = u32::from_le_bytes(*bytes);
        let scale = ((bits >> 27) as f32 - 24.0).exp2();
        [0, 9, 18].map(|shift| (bits >> shift & 511) as f32 * scale)
    })
}

/// Each pixel's mean radiance, from the bytes of the film's two halves.
pub fn means<'a>(rg: &'a [u8], bw: &'a [u8]) -> impl Iterator<Item = [f32; 3]> + 'a {
    let pairs = |bytes: &'a [u8]| bytes.as_chunks::<8>().0.iter().map(|p| bytemuck::cast(*p));
    pairs(rg).zip(pairs(bw)).map(|([r, g], [b, samples]): ([f32; 2], [f32; 2])| {
        [r, g, b].map(|sum| sum / samples.max(1.0))
    })
}
