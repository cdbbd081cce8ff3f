//! The environment map on the GPU, for where a ray meets nothing.
//!
//! In: a decoded picture. Out: a texture of four bytes a pixel, at most 8 MiB, and its bind
//! group; a single pixel where no picture is shown.

use super::{pipelines::Pipelines, targets};
use crate::scene::EnvironmentMap;

/// Nine bits a channel with one exponent: a quarter of what f32 would take, and filtered by
/// every GPU.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

/// Bits of a channel, and what is added to the exponent.
const MANTISSA_BITS: i32 = 9;
const EXPONENT_BIAS: i32 = 15;

/// What is bound for the background.
pub struct EnvironmentTexture {
    /// The picture's [`EnvironmentMap::id`]; none where there is none.
    pub id: Option<u64>,
    /// The texture.
    pub view: wgpu::TextureView,
    /// Bilinear, once around.
    pub sampler: wgpu::Sampler,
    /// Both.
    pub group: wgpu::BindGroup,
    /// What it takes of the GPU's memory.
    pub bytes: u64,
}

impl EnvironmentTexture {
    /// The picture, or a stand-in for none.
    pub fn new(pipelines: &Pipelines, environment_map: Option<&EnvironmentMap>) -> Self {
        let size_px = environment_map.map_or([1, 1], EnvironmentMap::size_px);
        let texels: Vec<u32> = match environment_map {
            Some(environment_map) => {
                environment_map.pixels().iter().map(|p| shared_exponent((*p).into())).collect()
            }
            None => vec![0],
        };
        let texture = texture(pipelines, size_px, &texels);
        let device = &pipelines.gpu.device;
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("environment map"),
            // Once around; the poles end it.
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::ClampToEdge,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let view = texture.create_view(&Default::default());
        let resources =
            [wgpu::BindingResource::TextureView(&view), wgpu::BindingResource::Sampler(&sampler)];
        let group = targets::group(
            device,
            &pipelines.layouts.environment_texture,
            "environment map",
            resources,
        );
        Self {
            id: environment_map.map(EnvironmentMap::id),
            view,
            sampler,
            group,
            bytes: 4 * texels.len() as u64,
        }
    }
}

/// What bindings of the group are.
pub const BINDINGS: [wgpu::BindingType; 2] = [
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    },
    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
];

fn texture(pipelines: &Pipelines, [width, height]: [u32; 2], texels: &[u32]) -> wgpu::Texture {
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = pipelines.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("environment map"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    pipelines.gpu.queue.write_texture(
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

/// Three channels, each finite and from 0 to 65408, in the bits of RGB9E5: red lowest, the
/// exponent highest. (WebGPU and Khronos' `EXT_texture_shared_exponent` say how.)
fn shared_exponent(color: [f32; 3]) -> u32 {
    let largest = color.into_iter().fold(0.0, f32::max);
    // The smallest exponent by which the largest channel, rounded, stays within its bits.
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

    /// The format's definition, read backward.
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
