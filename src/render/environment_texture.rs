//! The environment map on the GPU, as the background of rays that miss.
//!
//! In: a decoded environment map. Out: a texture of four bytes per pixel, at most 8 MiB, and its bind
//! group; a single pixel if no map is shown.

use super::{buffers, layouts::Layouts, shared_exponent};
use crate::scene::EnvironmentMap;

/// Nine bits per channel and a shared exponent: a quarter of the size of f32, and every GPU filters it.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgb9e5Ufloat;

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
            Some(environment_map) => environment_map
                .pixels()
                .iter()
                .map(|p| shared_exponent::pack((*p).into()))
                .collect(),
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
