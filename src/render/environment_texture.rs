//! The environment map on the GPU, as the background of rays that miss.
//!
//! In: a decoded environment map. Out: a texture of four bytes per pixel, at most 8 MiB, and its bind
//! group; a single pixel if no map is shown.

use super::{buffers, layouts::Layouts};
use crate::scene::EnvironmentMap;

/// Nine bits per channel and a shared exponent: a quarter of the size of f32, and every GPU filters it.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

/// Bits of a channel, and the bias of the exponent.
const MANTISSA_BITS: i32 = 9;
const EXPONENT_BIAS: i32 = 15;

/// The texture that is bound for the background.
pub struct EnvironmentTexture {
    /// The map's [`EnvironmentMap::id`]; none without a map.
    pub id: Option<u64>,
    /// A view of the texture.
    pub view: wgpu::TextureView,
    /// Bilinear, periodic in azimuth.
    pub sampler: wgpu::Sampler,
    /// The bind group of texture and sampler.
    pub group: wgpu::BindGroup,
    /// The texture's GPU memory in bytes.
    pub bytes: u64,
}

impl EnvironmentTexture {
    /// Uploads the map, or a single black pixel for none.
    pub fn new(layouts: &Layouts, environment_map: Option<&EnvironmentMap>) -> Self {
        let size_px = environment_map.map_or([1, 1], EnvironmentMap::size_px);
        let texels: Vec<u32> = match environment_map {
            Some(environment_map) => {
                environment_map.pixels().iter().map(|p| shared_exponent((*p).into())).collect()
            }
            None => vec![0],
        };
        let texture = texture(layouts, size_px, &texels);
        let device = &layouts.gpu.device;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("environment map"),
            // Periodic in azimuth, clamped at the poles.
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::ClampToEdge,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let view = texture.create_view(&Default::default());
        let resources =
            [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)];
        let group =
            buffers::group(device, &layouts.environment_texture, "environment map", resources);
        Self {
            id: environment_map.map(EnvironmentMap::id),
            view,
            sampler,
            group,
            bytes: 4 * texels.len() as u64,
        }
    }
}

fn texture(layouts: &Layouts, [width, height]: [u32; 2], texels: &[u32]) -> wgpu::Texture {
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = layouts.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("environment map"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    layouts.gpu.queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * width),
            rows_per_image: None,
        },
        size,
    );
    texture
}

/// Packs three channels, each finite and from 0 to 65408, as RGB9E5: red lowest, the exponent highest.
///
/// The format is defined by WebGPU and Khronos' `EXT_texture_shared_exponent`.
fn shared_exponent(color: [f32; 3]) -> u32 {
    let largest = color.into_iter().fold(0.0, f32::max);
    // The smallest exponent with which the largest channel, rounded, fits its bits.
    let least = -EXPONENT_BIAS;
    let mut exponent = if largest > 0.0 { largest.log2().floor() as i32 + 1 } else { least };
    exponent = exponent.clamp(least, 31 - EXPONENT_BIAS);
    let rounded = |exponent: i32| {
        let scale = f64::from(MANTISSA_BITS - exponent).exp2();
        color.map(|channel| (f64::from(channel) * scale).round() as u32)
    };
    let mut mantissas = rounded(exponent);
    if mantissas.iter().any(|&mantissa| mantissa >= 1 << MANTISSA_BITS)
        && exponent < 31 - EXPONENT_BIAS
    {
        exponent += 1;
        mantissas = rounded(exponent);
    }
    let [r, g, b] = mantissas.map(|mantissa| mantissa.min((1 << MANTISSA_BITS) - 1));
    r | g << 9 | b << 18 | ((exponent + EXPONENT_BIAS) as u32) << 27
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decodes RGB9E5 by the format's definition.
    fn unpacked(bits: u32) -> [f64; 3] {
        let scale = f64::from((bits >> 27) as i32 - EXPONENT_BIAS - MANTISSA_BITS).exp2();
        [0, 9, 18].map(|shift| f64::from(bits >> shift & 511) * scale)
    }

    #[test]
    fn packed_colours_come_back_to_half_a_step_of_their_largest_channel() {
        let colours = [
            [0.0, 0.0, 0.0],
            [1.0, 0.5, 0.25],
            [0.999_9, 0.1, 0.0],
            [1e-4, 2e-5, 0.0],
            [65_408.0, 1.0, 300.0],
            [511.75, 511.75, 3.0],
            [3e-9, 0.0, 0.0],
            [0.7, 0.700_1, 123.456],
        ];
        for colour in colours {
            let back = unpacked(shared_exponent(colour));
            let largest = f64::from(colour.into_iter().fold(0.0, f32::max));
            // Half a step of 9 bits, or of the smallest exponent.
            let step = (largest / 256.0).max((-24.0_f64).exp2());
            for (a, b) in colour.into_iter().zip(back) {
                assert!((f64::from(a) - b).abs() <= 0.501 * step, "{colour:?} {back:?}");
            }
        }
        assert_eq!(unpacked(shared_exponent([65_408.0; 3])), [65_408.0; 3]);
        assert_eq!(unpacked(shared_exponent([1.0; 3])), [1.0; 3]);
    }
}
