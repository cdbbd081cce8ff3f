//! Buffers and textures of light paths.

use std::sync::Arc;

use super::{
    buffers::{group, storage},
    environment_texture::EnvironmentTexture,
    layouts::Layouts,
    sky::SampledSky,
    uniforms::{PathCounts, PathState},
};
use crate::gpu::host_shared::HostShared;

/// The light paths of a batch, and the sky that they see.
pub struct PathTargets {
    /// Number of paths; 0 if no paths are traced.
    pub samples: u64,
    /// The sky; none without one.
    pub sky: Option<Arc<SampledSky>>,
    /// The sky's map.
    texture: Arc<EnvironmentTexture>,
    /// The sky's sampling table.
    table: wgpu::Texture,
    /// A [`PathState`] per sample of a batch.
    paths: wgpu::Buffer,
    /// An f32 per pixel, for the estimate of its noise.
    pub moments: wgpu::Buffer,
    /// [`PathCounts`].
    pub counts: wgpu::Buffer,
    /// The bind group of passes over paths: the sky's map, its sampler, its table, the paths.
    pub group: wgpu::BindGroup,
    /// The bind group of the passes after paths.
    pub traced_group: wgpu::BindGroup,
    /// The bind group of camera cones: the moments.
    pub moments_group: wgpu::BindGroup,
    sky_bytes: u64,
}

impl PathTargets {
    /// Allocates `samples` paths of a batch, moments of `pixels`, one at least, and the sky's textures.
    ///
    /// `guides`: the buffer for [guides of the denoiser](super::denoiser::DenoiserSources::guides). `shown`: the environment map's texture, which the sky shares if it is of the same map.
    pub fn new(
        layouts: &Layouts,
        [samples, pixels]: [u64; 2],
        sky: Option<&Arc<SampledSky>>,
        shown: Option<&Arc<EnvironmentTexture>>,
        guides: &wgpu::Buffer,
    ) -> Self {
        let device = &layouts.gpu.device;
        let moments = storage(device, "moments", 4 * pixels.max(1));
        let counts = storage(device, "path counts", PathCounts::SIZE as u64);
        let map = sky.map(|sky| &**sky.map());
        let shared = shown.filter(|shown| map.is_some_and(|map| shown.id == Some(map.id())));
        let texture = match shared {
            Some(shown) => shown.clone(),
            None => Arc::new(EnvironmentTexture::new(layouts, map)),
        };
        let table = table_texture(layouts, sky.map(|sky| &**sky));
        let paths = path_states(layouts, samples);
        Self {
            samples,
            sky: sky.cloned(),
            group: paths_group(layouts, &texture, &table, &paths),
            traced_group: traced_group(layouts, [&paths, &moments, &counts, guides]),
            moments_group: group(
                device,
                &layouts.moments,
                "moments",
                [moments.as_entire_binding()],
            ),
            sky_bytes: 16 * u64::from(table.width()) * u64::from(table.height())
                + if shared.is_some() { 0 } else { texture.bytes },
            texture,
            table,
            paths,
            moments,
            counts,
        }
    }

    /// Reallocates the path states for `samples` paths; keeps the moments of all pixels.
    ///
    /// `guides`: as in [`new`](Self::new).
    pub fn fit_samples(&mut self, layouts: &Layouts, samples: u64, guides: &wgpu::Buffer) {
        if samples == self.samples {
            return;
        }
        self.samples = samples;
        self.paths = path_states(layouts, samples);
        self.group = paths_group(layouts, &self.texture, &self.table, &self.paths);
        let traced = [&self.paths, &self.moments, &self.counts, guides];
        self.traced_group = traced_group(layouts, traced);
    }

    /// GPU memory in bytes; 0 if no paths are traced.
    pub fn bytes(&self) -> u64 {
        if self.samples == 0 {
            return 0;
        }
        self.paths.size() + self.moments.size() + self.sky_bytes
    }
}

fn path_states(layouts: &Layouts, samples: u64) -> wgpu::Buffer {
    storage(&layouts.gpu.device, "paths", samples.max(1) * PathState::SIZE as u64)
}

fn paths_group(
    layouts: &Layouts,
    texture: &EnvironmentTexture,
    table: &wgpu::Texture,
    paths: &wgpu::Buffer,
) -> wgpu::BindGroup {
    let view = table.create_view(&Default::default());
    let resources = [
        wgpu::BindingResource::TextureView(&texture.view),
        wgpu::BindingResource::Sampler(&texture.sampler),
        wgpu::BindingResource::TextureView(&view),
        paths.as_entire_binding(),
    ];
    group(&layouts.gpu.device, &layouts.paths, "paths", resources)
}

/// `buffers`: the paths, the moments, the counts, the guides.
fn traced_group(layouts: &Layouts, buffers: [&wgpu::Buffer; 4]) -> wgpu::BindGroup {
    let resources = buffers.map(wgpu::Buffer::as_entire_binding);
    group(&layouts.gpu.device, &layouts.traced_paths, "traced paths", resources)
}

/// The sky's table; a single empty cell without a sky.
fn table_texture(layouts: &Layouts, sky: Option<&SampledSky>) -> wgpu::Texture {
    let empty = [[0_u32; 4]];
    let (cells, [width, height]) =
        sky.map_or((&empty[..], [1, 1]), |sky| (sky.cells(), sky.size()));
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = layouts.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("sky table"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Uint,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    layouts.gpu.queue.write_texture(
        texture.as_image_copy(),
        bytemuck::cast_slice(cells),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(16 * width),
            rows_per_image: None,
        },
        size,
    );
    texture
}
