//! The buffers of one region: uniforms, G-buffers, film, display.
//!
//! Bytes per pixel: G-buffer 24, film 16, display 4, direct light 4 if it is the source of indirect
//! light. Rays, work queues and the G-buffer of jittered samples have the size of a batch, which grows where the GPU
//! takes large pieces of work.

use std::sync::Arc;

use super::{
    albedo_table::{ALBEDO_ENTRIES, ALBEDO_TABLE},
    buffers::{buffer, group, storage},
    color_curve::COLOR_BINS,
    denoiser::{Denoiser, DenoiserSources},
    environment_texture::EnvironmentTexture,
    lattice::{COARSEST, Grid, MAX_SAMPLES_TOGETHER, WORKGROUP_THREADS, sample_places},
    layouts::DISPLAY_FORMAT,
    layouts::Layouts,
    memory::Memory,
    path_targets::PathTargets,
    post::{Need, Post},
    region::Region,
    schedule::{BATCH_WORKGROUPS, MAX_BATCH_WORKGROUPS},
    shutter::Shutter,
    sky::SampledSky,
    uniforms::{self, DispatchParams, FRAME_BYTES, GRADIENT_ENTRIES, Light, Ray},
    work_queues::{RAY_QUEUES, WorkQueues},
};
use crate::{
    formula::contract::MAX_TABLE_BYTES,
    gpu::host_shared::{HostShared, bytes_of_all},
    scene::MAX_LIGHTS,
};

/// Distance between two elements of `dispatch_params`: the default alignment of dynamic offsets.
pub const DISPATCH_PARAMS_STRIDE_BYTES: u32 = 256;

/// Bytes of one pixel's direct light.
const DIRECT_BYTES: u64 = 4;

/// Most dispatches of one submit: `camera_rays`, `camera_cone`, `compact_hits`, `film_paths`, and for each vertex of a
/// path `march`, `normal`, `scatter` and `shadow`. Direct light has fewer: two per light.
pub const MAX_DISPATCHES: u32 = 2 * RAY_QUEUES as u32 + 4;

const _: () = assert!(MAX_DISPATCHES >= 2 * MAX_LIGHTS as u32 + 6);

/// Bytes of the [`ALBEDO_TABLE`].
const ALBEDO_TABLE_BYTES: u64 = size_of::<[[f32; 2]; ALBEDO_ENTRIES * ALBEDO_ENTRIES]>() as u64;

/// G-buffer: one element per sample in each buffer; see `shaders/types/gbuffer.wgsl`.
pub struct GBuffer {
    /// f32 depth along the ray in render space, 0 on a miss; u32 octahedral normal.
    pub surface: wgpu::Buffer,
    /// 2 × u32: smooth iterations and orbit traps.
    pub color_data: wgpu::Buffer,
    /// 2 × u32: one bit per light. Under paths the centre samples' buffer holds guides of the denoiser.
    pub visibility: wgpu::Buffer,
    /// The bind group of all three buffers and the rays.
    pub group: wgpu::BindGroup,
}

/// All buffers and textures of a region.
pub struct Targets {
    /// The frame uniforms, with the formula's part.
    pub frame: wgpu::Buffer,
    /// The formula's table: the reference orbit, in deep views.
    pub formula_table: wgpu::Buffer,
    /// [`MAX_DISPATCHES`] elements of [`DispatchParams`], [`DISPATCH_PARAMS_STRIDE_BYTES`] apart.
    pub dispatch_params: wgpu::Buffer,
    /// [`MAX_LIGHTS`] elements of [`Light`].
    pub lights: wgpu::Buffer,
    /// [`GRADIENT_ENTRIES`] colours for each layer.
    pub gradients: wgpu::Buffer,
    /// Directional albedo of glossy reflection: see [`albedo_table`](super::albedo_table). Zeros until a surface has it.
    pub albedo_table: wgpu::Buffer,
    /// The bind group of all six buffers.
    pub frame_group: wgpu::BindGroup,
    /// Most workgroups of a batch.
    pub batch_workgroups: u32,
    /// Workgroups of the region's largest trace: the upper limit of `batch_workgroups`.
    pub all_workgroups: u32,
    /// The rays of one batch.
    pub rays: wgpu::Buffer,
    /// The centre samples of all pixels.
    pub center: GBuffer,
    /// The jittered samples of one batch.
    pub jittered: GBuffer,
    /// Work queues between the passes of a batch.
    pub work_queues: WorkQueues,
    /// 2 × f32 per pixel: sums of red and green.
    pub film_rg: wgpu::Buffer,
    /// 2 × f32 per pixel: sum of blue, number of samples.
    pub film_bw: wgpu::Buffer,
    /// u32 per pixel: direct light of the centre samples, shared exponent.
    ///
    /// A few bytes until there is indirect light.
    pub direct: wgpu::Buffer,
    /// The bind group of the film, the display texture and direct light.
    pub film_group: wgpu::BindGroup,
    /// u32 per bin: the number of hits by the value that selects their colour.
    pub color_bins: wgpu::Buffer,
    /// The bind group of the bins.
    pub color_bins_group: wgpu::BindGroup,
    /// Film statistics: a few bytes until a pass needs them.
    pub post: Arc<Post>,
    /// The environment map: a single pixel until a map is shown.
    pub environment_texture: Arc<EnvironmentTexture>,
    /// Light paths, and the sky that they see: a few bytes until paths are traced.
    pub paths: PathTargets,
    /// The denoiser's light: a few bytes until there is something to denoise.
    pub denoiser: Denoiser,
    /// Sums of sub-frames: a few bytes without motion blur.
    pub shutter: Shutter,
    /// The display picture.
    pub texture: wgpu::Texture,
}

impl Targets {
    /// Allocates the buffers of a region.
    pub fn new(layouts: &Layouts, region: Region) -> Self {
        let size_px = region.film_px();
        let device = &layouts.gpu.device;
        let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
        // A batch holds whole workgroups, some of them past the region's last pixels. Samples that are
        // computed together need the most workgroups.
        let all_workgroups = Grid::samples(MAX_SAMPLES_TOGETHER, size_px).workgroups();
        let batch_workgroups = all_workgroups.min(BATCH_WORKGROUPS);
        let batch_samples = u64::from(batch_workgroups * WORKGROUP_THREADS);
        let rays = storage(device, "rays", batch_samples * Ray::SIZE as u64);
        let uniform = |label, bytes| buffer(device, label, bytes, wgpu::BufferUsages::UNIFORM);
        let frame = storage(device, "frame uniforms", FRAME_BYTES);
        let formula_table = uniform("formula's table", MAX_TABLE_BYTES as u64);
        let dispatch_params = uniform(
            "dispatch parameters",
            u64::from(MAX_DISPATCHES * DISPATCH_PARAMS_STRIDE_BYTES),
        );
        let lights = uniform("lights", (Light::SIZE * MAX_LIGHTS) as u64);
        let gradients = uniform("gradients", size_of::<[[[f32; 4]; GRADIENT_ENTRIES]; 2]>() as u64);
        let albedo_table = uniform("albedo table", ALBEDO_TABLE_BYTES);
        let one_dispatch = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &dispatch_params,
            offset: 0,
            size: wgpu::BufferSize::new(DispatchParams::SIZE as u64),
        });
        let frame_group = group(
            device,
            &layouts.frame,
            "frame",
            [
                frame.as_entire_binding(),
                formula_table.as_entire_binding(),
                one_dispatch,
                lights.as_entire_binding(),
                gradients.as_entire_binding(),
                albedo_table.as_entire_binding(),
            ],
        );
        let film_rg = storage(device, "film red green", 8 * pixels);
        let film_bw = storage(device, "film blue weight", 8 * pixels);
        let texture = display_texture(device, region.display_px());
        let direct = storage(device, "direct light", DIRECT_BYTES);
        let film_group = film_group(layouts, [&film_rg, &film_bw, &direct], &texture);
        let color_bins = storage(device, "colour bins", 2 * 4 * COLOR_BINS as u64);
        let color_bins_group =
            group(device, &layouts.color_bins, "colour bins", [color_bins.as_entire_binding()]);
        let center = GBuffer::new(layouts, pixels, &rays);
        let paths = PathTargets::new(layouts, [0, 0], None, None, &center.visibility);
        let denoiser = Denoiser::new(layouts, 0, denoiser_sources(&center, &paths));
        let shutter = Shutter::new(layouts, 0, averaged(&center, &paths));
        Self {
            frame,
            formula_table,
            dispatch_params,
            lights,
            gradients,
            albedo_table,
            frame_group,
            center,
            batch_workgroups,
            all_workgroups,
            jittered: GBuffer::new(layouts, batch_samples, &rays),
            rays,
            work_queues: WorkQueues::new(layouts, batch_workgroups, false),
            paths,
            denoiser,
            shutter,
            film_rg,
            film_bw,
            direct,
            film_group,
            color_bins,
            color_bins_group,
            post: Arc::new(Post::new(layouts, region, Need::default())),
            environment_texture: Arc::new(EnvironmentTexture::new(layouts, None)),
            texture,
        }
    }

    /// Enlarges the buffers of a batch for a trace of `workgroups`; returns whether they grew.
    ///
    /// They grow if the trace fills two batches. Buffers of paths are those of [`fit_paths`](Self::fit_paths).
    pub fn fit_batch(&mut self, layouts: &Layouts, workgroups: u32) -> bool {
        let most = self.all_workgroups.min(MAX_BATCH_WORKGROUPS);
        let workgroups = workgroups.min(most);
        if workgroups < 2 * self.batch_workgroups {
            return false;
        }
        let wanted = workgroups.next_power_of_two().min(most);
        let samples = u64::from(wanted * WORKGROUP_THREADS);
        self.rays = storage(&layouts.gpu.device, "rays", samples * Ray::SIZE as u64);
        self.center.bind_rays(layouts, &self.rays);
        self.jittered = GBuffer::new(layouts, samples, &self.rays);
        self.work_queues = WorkQueues::new(layouts, wanted, self.work_queues.for_paths);
        self.batch_workgroups = wanted;
        true
    }

    /// Allocates direct light for all pixels if needed, else frees it.
    pub fn fit_direct(&mut self, layouts: &Layouts, needed: bool) {
        let pixels = self.film_rg.size() / 8;
        let bytes = DIRECT_BYTES * if needed { pixels } else { 1 };
        if self.direct.size() != bytes {
            self.direct = storage(&layouts.gpu.device, "direct light", bytes);
            self.film_group = self.film_with(layouts, &self.direct);
        }
    }

    /// Allocates the paths of a batch and the sky's textures if paths are traced, else frees them.
    pub fn fit_paths(&mut self, layouts: &Layouts, traced: bool, sky: Option<&Arc<SampledSky>>) {
        let samples = u64::from(self.batch_workgroups * WORKGROUP_THREADS);
        let needed = if traced { samples } else { 0 };
        let is_sky_current = self.paths.sky.as_ref() == sky;
        if is_sky_current && self.paths.samples.min(needed) > 0 {
            self.paths.fit_samples(layouts, needed, &self.center.visibility);
        } else if self.paths.samples != needed || !is_sky_current {
            let shown = &self.environment_texture;
            let pixels = if traced { self.film_rg.size() / 8 } else { 0 };
            self.paths = PathTargets::new(
                layouts,
                [needed, pixels],
                sky,
                Some(shown),
                &self.center.visibility,
            );
        }
        if self.work_queues.for_paths != traced {
            self.work_queues = WorkQueues::new(layouts, self.batch_workgroups, traced);
        }
    }

    /// Allocates the display picture of `region` anew if it has not `texels` per pixel along x.
    pub fn fit_display(&mut self, layouts: &Layouts, region: Region, texels: u32) {
        let [width, height] = region.display_px();
        if self.texture.width() != width * texels {
            self.texture = display_texture(&layouts.gpu.device, [width * texels, height]);
            self.film_group = self.film_with(layouts, &self.direct);
        }
    }

    /// Allocates light for the denoiser if needed, else frees it.
    pub fn fit_denoiser(&mut self, layouts: &Layouts, needed: bool) {
        let sources = denoiser_sources(&self.center, &self.paths);
        let pixels = if needed { self.film_rg.size() / 8 } else { 0 };
        if !self.denoiser.fits(pixels, &sources) {
            self.denoiser = Denoiser::new(layouts, pixels, sources);
        }
    }

    /// Allocates sums of sub-frames if needed, else frees them.
    pub fn fit_shutter(&mut self, layouts: &Layouts, needed: bool) {
        let averaged = averaged(&self.center, &self.paths);
        let pixels = if needed { self.film_rg.size() / 8 } else { 0 };
        if !self.shutter.fits(pixels, &averaged) {
            self.shutter = Shutter::new(layouts, pixels, averaged);
        }
    }

    /// Finest lattice level whose display values fit the buffer of rays.
    ///
    /// `upsample` reuses that buffer. The level is at least 2, a quarter of all pixels.
    pub fn finest_upsampled_level(&self, size_px: [u32; 2]) -> u32 {
        let room = self.rays.size() / 4;
        let fits = |&level: &u32| sample_places(level, size_px) <= room;
        (2..COARSEST).find(fits).unwrap_or(COARSEST)
    }

    /// The GPU memory of all buffers and textures.
    pub fn memory(&self) -> Memory {
        let [mip_levels, blur] = self.post.bytes();
        let uniforms = [
            &self.frame,
            &self.formula_table,
            &self.dispatch_params,
            &self.lights,
            &self.gradients,
            &self.albedo_table,
        ];
        Memory {
            sample_points: self.center.bytes(),
            jittered_samples: self.jittered.bytes(),
            rays: self.rays.size(),
            work_queues: self.work_queues.bytes(),
            paths: self.paths.bytes(),
            denoiser: self.denoiser.bytes(),
            shutter: self.shutter.bytes(),
            direct_light: self.direct.size(),
            film: self.film_rg.size() + self.film_bw.size(),
            mip_levels,
            blur,
            environment_map: self.environment_texture.bytes,
            display: texture_bytes(&self.texture),
            uniforms: uniforms.into_iter().map(wgpu::Buffer::size).sum::<u64>()
                + self.color_bins.size()
                + self.post.statistics.size(),
        }
    }

    /// The film's bind group with another buffer of direct light.
    pub fn film_with(&self, layouts: &Layouts, direct: &wgpu::Buffer) -> wgpu::BindGroup {
        film_group(layouts, [&self.film_rg, &self.film_bw, direct], &self.texture)
    }

    /// Uploads the uniforms of a picture.
    pub fn upload(&self, queue: &wgpu::Queue, inputs: &uniforms::Inputs) {
        queue.write_buffer(&self.frame, 0, &inputs.frame_bytes());
        queue.write_buffer(&self.formula_table, 0, &inputs.formula.table);
        queue.write_buffer(&self.lights, 0, &bytes_of_all(&inputs.lights));
        queue.write_buffer(&self.gradients, 0, bytemuck::cast_slice(&inputs.gradients));
        if inputs.frame.surface.model != 0 {
            queue.write_buffer(&self.albedo_table, 0, bytemuck::cast_slice(&ALBEDO_TABLE));
        }
    }
}

/// GPU memory of a display texture, in bytes.
pub fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    4 * u64::from(texture.width()) * u64::from(texture.height())
}

impl GBuffer {
    fn bytes(&self) -> u64 {
        self.surface.size() + self.color_data.size() + self.visibility.size()
    }

    fn new(layouts: &Layouts, samples: u64, rays: &wgpu::Buffer) -> Self {
        let device = &layouts.gpu.device;
        let surface = storage(device, "surface", 8 * samples);
        let color_data = storage(device, "colour data", 8 * samples);
        let visibility = storage(device, "visibility", 8 * samples);
        let group = gbuffer_group(layouts, [&surface, &color_data, &visibility, rays]);
        Self { surface, color_data, visibility, group }
    }

    /// Binds other rays.
    fn bind_rays(&mut self, layouts: &Layouts, rays: &wgpu::Buffer) {
        let buffers = [&self.surface, &self.color_data, &self.visibility, rays];
        self.group = gbuffer_group(layouts, buffers);
    }
}

fn gbuffer_group(layouts: &Layouts, buffers: [&wgpu::Buffer; 4]) -> wgpu::BindGroup {
    let resources = buffers.map(wgpu::Buffer::as_entire_binding);
    group(&layouts.gpu.device, &layouts.gbuffer, "gbuffer", resources)
}

/// Paths keep the guides in place of the centre samples' visibility: see `GBufferValidity`.
fn denoiser_sources(center: &GBuffer, paths: &PathTargets) -> DenoiserSources {
    let GBuffer { surface, visibility, .. } = center;
    DenoiserSources {
        moments: paths.moments.clone(),
        guides: visibility.clone(),
        surface: surface.clone(),
    }
}

/// What sub-frames average besides their films.
fn averaged(center: &GBuffer, paths: &PathTargets) -> [wgpu::Buffer; 2] {
    let DenoiserSources { moments, guides, .. } = denoiser_sources(center, paths);
    [moments, guides]
}

fn film_group(
    layouts: &Layouts,
    [film_rg, film_bw, direct]: [&wgpu::Buffer; 3],
    texture: &wgpu::Texture,
) -> wgpu::BindGroup {
    let view = texture.create_view(&Default::default());
    let resources = [
        film_rg.as_entire_binding(),
        film_bw.as_entire_binding(),
        wgpu::BindingResource::TextureView(&view),
        direct.as_entire_binding(),
    ];
    group(&layouts.gpu.device, &layouts.film, "film", resources)
}

fn display_texture(device: &wgpu::Device, [width, height]: [u32; 2]) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("display"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DISPLAY_FORMAT,
        usage: wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
