//! The buffers of one region: uniforms, G-buffers, film, display.
//!
//! Bytes a pixel: G-buffer 24, film 16, display 4, direct light 4 where indirect light is made of
//! it; the G-buffer of jittered samples is a slice large, whatever the region.

use std::sync::Arc;

use super::{
    environment_texture::EnvironmentTexture,
    indirect::IndirectSource,
    lattice::{COARSEST, Grid, MOST_TOGETHER, WORKGROUP_THREADS},
    memory::Memory,
    pass,
    pipelines::Pipelines,
    post::{Need, Post},
    region::Region,
    schedule::{MOST_WORKGROUPS, SAMPLE_WORKGROUPS},
    uniforms::{self, ANCHOR_ORBIT_BYTES, FrameUniforms, GRADIENT_ENTRIES, Light, Slice},
    work_queues::WorkQueues,
};
use crate::scene::MAX_LIGHTS;

/// Gamma-space 8-bit colour: what egui shows and PNG stores.
pub const DISPLAY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Distance between two slices in their uniform buffer, the default alignment of dynamic offsets.
pub const SLICE_STRIDE_BYTES: u32 = 256;

/// Direct light of one pixel.
const DIRECT_BYTES: u64 = 4;

/// Most dispatches of one submit: two that march, hits, normal, two a light, shade.
pub const MOST_SLICES: u32 = 2 * MAX_LIGHTS as u32 + 5;

/// One element a sample point in each buffer; see `shaders/types/gbuffer.wgsl`.
pub struct GBuffer {
    /// f32 depth along the ray in the view's unit, 0 on a miss; u32 octahedral normal.
    pub surface: wgpu::Buffer,
    /// 2 × u32: smooth iterations and traps.
    pub color_data: wgpu::Buffer,
    /// 2 × u32: a bit a light.
    pub visibility: wgpu::Buffer,
    /// All three.
    pub group: wgpu::BindGroup,
}

/// Everything a region is rendered with and into.
pub struct Targets {
    /// [`FrameUniforms`].
    pub frame: wgpu::Buffer,
    /// The anchor's orbit, as far as the picture does not hold it.
    pub anchor_orbit: wgpu::Buffer,
    /// [`MOST_SLICES`] of [`Slice`], [`SLICE_STRIDE_BYTES`] apart.
    pub slices: wgpu::Buffer,
    /// [`MAX_LIGHTS`] of [`Light`].
    pub lights: wgpu::Buffer,
    /// [`GRADIENT_ENTRIES`] colours.
    pub gradient: wgpu::Buffer,
    /// All five.
    pub frame_group: wgpu::BindGroup,
    /// Every pixel's centre sample, kept.
    pub center: GBuffer,
    /// The jittered samples of one slice.
    pub jittered: GBuffer,
    /// Work queues between the passes of a piece of work.
    pub work_queues: WorkQueues,
    /// 2 × f32 a pixel: sums of red and green.
    pub film_rg: wgpu::Buffer,
    /// 2 × f32 a pixel: sum of blue, number of samples.
    pub film_bw: wgpu::Buffer,
    /// u32 a pixel: direct light of the centre samples, shared exponent; next to nothing until
    /// indirect light is made of it.
    pub direct: wgpu::Buffer,
    /// The film, the display texture and direct light.
    pub film_group: wgpu::BindGroup,
    /// What is known of the film as a whole: next to nothing until something needs it.
    pub post: Arc<Post>,
    /// The environment map: a stand-in until one is shown.
    pub environment_texture: Arc<EnvironmentTexture>,
    /// The display picture.
    pub texture: wgpu::Texture,
}

impl Targets {
    /// Allocates what a region needs.
    pub fn new(pipelines: &Pipelines, region: Region) -> Self {
        let size_px = region.film_px();
        let device = &pipelines.gpu.device;
        let layouts = &pipelines.layouts;
        let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
        // A slice holds whole workgroups, some of them past the region's last pixels.
        // As many as there can be: of samples that are computed together.
        let workgroups = Grid::samples(MOST_TOGETHER, size_px).workgroups();
        let slice_samples = workgroups.min(SAMPLE_WORKGROUPS) * WORKGROUP_THREADS;
        let uniform = |label, bytes| buffer(device, label, bytes, wgpu::BufferUsages::UNIFORM);
        let frame = storage(device, "frame uniforms", size_of::<FrameUniforms>() as u64);
        let anchor_orbit = uniform("anchor's orbit", ANCHOR_ORBIT_BYTES);
        let slices = uniform("slices", u64::from(MOST_SLICES * SLICE_STRIDE_BYTES));
        let lights = uniform("lights", size_of::<[Light; MAX_LIGHTS]>() as u64);
        let gradient = uniform("gradient", size_of::<[[f32; 4]; GRADIENT_ENTRIES]>() as u64);
        let one_slice = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &slices,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<Slice>() as u64),
        });
        let frame_group = group(
            device,
            &layouts.frame,
            "frame",
            [
                frame.as_entire_binding(),
                anchor_orbit.as_entire_binding(),
                one_slice,
                lights.as_entire_binding(),
                gradient.as_entire_binding(),
            ],
        );
        let film_rg = storage(device, "film red green", 8 * pixels);
        let film_bw = storage(device, "film blue weight", 8 * pixels);
        let texture = display_texture(device, region.display_px());
        let direct = storage(device, "direct light", DIRECT_BYTES);
        let film_group = film_group(pipelines, [&film_rg, &film_bw, &direct], &texture);
        Self {
            frame,
            anchor_orbit,
            slices,
            lights,
            gradient,
            frame_group,
            center: GBuffer::new(pipelines, pixels),
            jittered: GBuffer::new(pipelines, u64::from(slice_samples)),
            work_queues: WorkQueues::new(pipelines, workgroups.min(MOST_WORKGROUPS)),
            film_rg,
            film_bw,
            direct,
            film_group,
            post: Arc::new(Post::new(pipelines, region, Need::default())),
            environment_texture: Arc::new(EnvironmentTexture::new(pipelines, None)),
            texture,
        }
    }

    /// Makes room for direct light where indirect light is made of it, and frees it elsewhere.
    pub fn fit_direct(&mut self, pipelines: &Pipelines, needed: bool) {
        let pixels = self.film_rg.size() / 8;
        let bytes = DIRECT_BYTES * if needed { pixels } else { 1 };
        if self.direct.size() != bytes {
            self.direct = storage(&pipelines.gpu.device, "direct light", bytes);
            self.film_group = self.film_with(pipelines, &self.direct);
        }
    }

    /// The finest lattice level whose samples have room, once developed, where jittered samples
    /// have their visibility bits at other times: 2 or more, for it is a quarter of all pixels.
    pub fn finest_spread(&self, size_px: [u32; 2]) -> u32 {
        let room = self.jittered.visibility.size() / 4;
        let fits = |&level: &u32| pass::tonemap_sparse::places(level, size_px) <= room;
        (2..COARSEST).find(fits).unwrap_or(COARSEST)
    }

    /// What all of it takes.
    pub fn memory(&self) -> Memory {
        let [mip_levels, blur] = self.post.bytes();
        let uniforms =
            [&self.frame, &self.anchor_orbit, &self.slices, &self.lights, &self.gradient];
        Memory {
            sample_points: self.center.bytes(),
            jittered_samples: self.jittered.bytes(),
            work_queues: self.work_queues.bytes(),
            direct_light: self.direct.size(),
            film: self.film_rg.size() + self.film_bw.size(),
            mip_levels,
            blur,
            environment_map: self.environment_texture.bytes,
            display: texture_bytes(&self.texture),
            uniforms: uniforms.into_iter().map(wgpu::Buffer::size).sum::<u64>()
                + self.post.statistics.size(),
        }
    }

    /// This region's own centre samples; `eye_px` is one eye's picture.
    pub fn indirect_source(&self, eye_px: [u32; 2]) -> IndirectSource {
        IndirectSource { eye_px, surface: self.center.surface.clone(), direct: self.direct.clone() }
    }

    /// The film's group with direct light of another view.
    pub fn film_with(&self, pipelines: &Pipelines, direct: &wgpu::Buffer) -> wgpu::BindGroup {
        film_group(pipelines, [&self.film_rg, &self.film_bw, direct], &self.texture)
    }

    /// Uploads a picture's uniforms.
    pub fn upload(&self, queue: &wgpu::Queue, inputs: &uniforms::Inputs) {
        queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&inputs.frame));
        queue.write_buffer(&self.anchor_orbit, 0, &inputs.anchor_orbit());
        queue.write_buffer(&self.lights, 0, bytemuck::bytes_of(&inputs.lights));
        queue.write_buffer(&self.gradient, 0, bytemuck::cast_slice(&inputs.gradient));
    }
}

/// What a display texture takes.
pub fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    4 * u64::from(texture.width()) * u64::from(texture.height())
}

impl GBuffer {
    fn bytes(&self) -> u64 {
        self.surface.size() + self.color_data.size() + self.visibility.size()
    }

    fn new(pipelines: &Pipelines, samples: u64) -> Self {
        let device = &pipelines.gpu.device;
        let surface = storage(device, "surface", 8 * samples);
        let color_data = storage(device, "colour data", 8 * samples);
        let visibility = storage(device, "visibility", 8 * samples);
        let group = group(
            device,
            &pipelines.layouts.gbuffer,
            "gbuffer",
            [&surface, &color_data, &visibility].map(wgpu::Buffer::as_entire_binding),
        );
        Self { surface, color_data, visibility, group }
    }
}

fn film_group(
    pipelines: &Pipelines,
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
    group(&pipelines.gpu.device, &pipelines.layouts.film, "film", resources)
}

fn buffer(
    device: &wgpu::Device,
    label: &str,
    size: u64,
    usage: wgpu::BufferUsages,
) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// A storage buffer that can be read back.
pub(super) fn storage(device: &wgpu::Device, label: &str, size: u64) -> wgpu::Buffer {
    buffer(device, label, size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC)
}

/// A bind group of `resources`, in the order of their bindings.
pub(super) fn group<const N: usize>(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    label: &str,
    resources: [wgpu::BindingResource<'_>; N],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
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
