//! Reads back the pixels of a view: radiance, depth and normal.
//!
//! In: a view's film and G-buffer. Out: every pixel's radiance, depth and normal, once all buffers have
//! arrived; no call blocks.

use glam::Vec3;

use super::{gbuffer::Samples, shared_exponent};
use crate::gpu::{
    Gpu,
    readback::{Readback, ReadbackError},
};

/// One pixel of a finished picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSample {
    /// Mean radiance of its samples, linear Rec. 709; before a transparent background, times the opacity.
    pub radiance: [f32; 3],
    /// Part of its samples that a transparent background leaves, 0 to 1; none before another background.
    pub opacity: Option<f32>,
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
pub enum Light<T> {
    /// The film's two halves.
    Film([T; 2]),
    /// Denoised light, in shared exponents.
    Denoised(T),
}

/// A pending readback of a view's buffers.
pub struct SamplesReadback {
    light: Light<Arrival>,
    surface: Arrival,
    guides: Option<Arrival>,
    /// The film's half with the weights, and a finished pixel's samples, before a transparent background.
    weights: Option<(Arrival, f32)>,
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
    /// `weights` are, before a transparent background, the film's half with the weights and a finished pixel's
    /// samples. Depths are in units of `scale` scene units.
    pub fn new(
        gpu: &Gpu,
        light: Light<&wgpu::Buffer>,
        surface: &wgpu::Buffer,
        guides: Option<&wgpu::Buffer>,
        weights: Option<(&wgpu::Buffer, f32)>,
        scale: f64,
    ) -> Self {
        let read = |buffer| Arrival::Awaited(Readback::buffer(gpu, buffer));
        let light = match light {
            Light::Film(halves) => Light::Film(halves.map(read)),
            Light::Denoised(buffer) => Light::Denoised(read(buffer)),
        };
        let weights = weights.map(|(buffer, samples)| (read(buffer), samples));
        Self { light, surface: read(surface), guides: guides.map(read), weights, scale }
    }

    /// Every pixel, rows from the top, once all buffers have arrived; none before.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn take(&mut self, gpu: &Gpu) -> Result<Option<Vec<PixelSample>>, ReadbackError> {
        let Some(surface) = self.surface.look(gpu)? else { return Ok(None) };
        let surface = Samples::decode(surface, &[], self.scale);
        let guides: Vec<Guides> = match &mut self.guides {
            None => Vec::new(),
            Some(arrival) => {
                let Some(bytes) = arrival.look(gpu)? else { return Ok(None) };
                Guides::decode(bytes).collect()
            }
        };
        let opacities: Vec<f32> = match &mut self.weights {
            None => Vec::new(),
            Some((arrival, samples)) => {
                let Some(bytes) = arrival.look(gpu)? else { return Ok(None) };
                let halves = bytes.as_chunks::<8>().0.iter();
                halves.map(|half| bytemuck::cast::<_, [f32; 2]>(*half)[1] / *samples).collect()
            }
        };
        let points = surface.depth.into_iter().zip(surface.normal).enumerate();
        let pixel = |(radiance, (i, (depth, normal))): ([f32; 3], (usize, _))| {
            let opacity = opacities.get(i).map(|opacity| opacity.clamp(0.0, 1.0));
            PixelSample {
                radiance: radiance.map(|channel| channel * opacity.unwrap_or(1.0)),
                opacity,
                depth,
                normal,
                guides: guides.get(i).copied(),
            }
        };
        Ok(match &mut self.light {
            Light::Film([rg, bw]) => match [rg.look(gpu)?, bw.look(gpu)?] {
                [Some(rg), Some(bw)] => Some(means(rg, bw).zip(points).map(pixel).collect()),
                _ => None,
            },
            Light::Denoised(light) => {
                light.look(gpu)?.map(|light| denoised(light).zip(points).map(pixel).collect())
            }
        })
    }
}

/// Each pixel's radiance, from the bytes of denoised light.
pub fn denoised(packed: &[u8]) -> impl Iterator<Item = [f32; 3]> + '_ {
    let colors = packed.as_chunks::<4>().0.iter();
    colors.map(|bytes| {
        shared_exponent::unpack(u32::from_le_bytes(*bytes)).map(|channel| channel as f32)
    })
}

/// Each pixel's mean radiance, from the bytes of the film's two halves.
pub fn means<'a>(rg: &'a [u8], bw: &'a [u8]) -> impl Iterator<Item = [f32; 3]> + 'a {
    let pairs = |bytes: &'a [u8]| bytes.as_chunks::<8>().0.iter().map(|p| bytemuck::cast(*p));
    pairs(rg).zip(pairs(bw)).map(|([r, g], [b, samples]): ([f32; 2], [f32; 2])| {
        [r, g, b].map(|sum| sum / if samples == 0.0 { 1.0 } else { samples })
    })
}
