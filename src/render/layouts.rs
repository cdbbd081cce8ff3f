//! Bind group layouts of the passes.

use crate::gpu::Gpu;

/// Gamma-space 8-bit colour: what egui shows and PNG stores.
pub const DISPLAY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What bindings of the group are.
const ENVIRONMENT_BINDINGS: [wgpu::BindingType; 2] = [
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    },
    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
];

/// A device with the bind group layouts of all passes.
pub struct Layouts {
    /// The device.
    pub gpu: Gpu,
    /// Group 0: frame uniforms (a storage buffer), formula table (reference orbit), dispatch parameters (dynamic offset),
    /// lights, gradient, albedo table.
    pub frame: wgpu::BindGroupLayout,
    /// Group 1: surface, colour data, visibility, rays; all storage.
    pub gbuffer: wgpu::BindGroupLayout,
    /// Group 1 of the indirect pass: surface, colour data, visibility; all read only.
    pub samples: wgpu::BindGroupLayout,
    /// Group 1 of passes over the whole film: statistics, mip levels, half blurred; all storage.
    pub post: wgpu::BindGroupLayout,
    /// Group 2 of passes that read a work queue: the queues.
    pub dequeue: wgpu::BindGroupLayout,
    /// Group 2 of passes that write work queues: the queues, and the workgroup counts of their readers.
    pub enqueue: wgpu::BindGroupLayout,
    /// Group 2 of the pass that counts colour values: its bins.
    pub color_bins: wgpu::BindGroupLayout,
    /// Group 2: the film's two halves, the display texture, direct light.
    pub film: wgpu::BindGroupLayout,
    /// Group 3 of shading: the environment map and its sampler.
    pub environment_texture: wgpu::BindGroupLayout,
    /// Group 3 of passes over light paths: the sky's map, its sampler, its table, the paths.
    pub paths: wgpu::BindGroupLayout,
    /// Group 1 of passes after light paths: the paths, the pixels' moments, the number of noisy pixels, guides.
    pub traced_paths: wgpu::BindGroupLayout,
    /// Group 1 of the denoiser's input: the pixels' moments, guides, light.
    pub denoise_input: wgpu::BindGroupLayout,
    /// Group 1 of the pass that averages sub-frames: their sums, the pixels' moments, guides.
    pub shutter: wgpu::BindGroupLayout,
    /// Group 1 of the denoiser: guides, surface, light before and after even iterations.
    pub denoise: wgpu::BindGroupLayout,
    /// Group 3 of tone mapping: denoised light.
    pub denoised: wgpu::BindGroupLayout,
    /// Group 3 of cones of camera rays: the pixels' moments.
    pub moments: wgpu::BindGroupLayout,
    /// Group 3 of the indirect pass: the environment map, its sampler, the indirect source's surface.
    pub indirect: wgpu::BindGroupLayout,
}

impl Layouts {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let group = |label, kinds: &[wgpu::BindingType]| {
            let entries: Vec<_> = (0..).zip(kinds).map(|(i, kind)| entry(i, *kind)).collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        };
        let display = wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: DISPLAY_FORMAT,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        let [environment_texture_binding, environment_sampler_binding] = ENVIRONMENT_BINDINGS;
        Self {
            gpu: gpu.clone(),
            frame: group(
                "frame",
                &[
                    READ_ONLY,
                    uniform(false),
                    uniform(true),
                    uniform(false),
                    uniform(false),
                    uniform(false),
                ],
            ),
            gbuffer: group("gbuffer", &[STORAGE; 4]),
            samples: group("samples", &[READ_ONLY; 3]),
            post: group("post", &[STORAGE; 3]),
            dequeue: group("dequeue", &[STORAGE]),
            enqueue: group("enqueue", &[STORAGE; 2]),
            color_bins: group("colour bins", &[STORAGE]),
            film: group("film", &[STORAGE, STORAGE, display, STORAGE]),
            environment_texture: group(
                "environment map",
                &[environment_texture_binding, environment_sampler_binding],
            ),
            paths: group(
                "paths",
                &[environment_texture_binding, environment_sampler_binding, SKY_TABLE, STORAGE],
            ),
            traced_paths: group("traced paths", &[READ_ONLY, STORAGE, STORAGE, STORAGE]),
            denoise_input: group("denoise input", &[READ_ONLY, STORAGE, STORAGE]),
            shutter: group("shutter", &[STORAGE; 3]),
            denoise: group("denoise", &[READ_ONLY, READ_ONLY, STORAGE, STORAGE]),
            denoised: group("denoised", &[READ_ONLY]),
            moments: group("moments", &[READ_ONLY]),
            indirect: group(
                "indirect source",
                &[environment_texture_binding, environment_sampler_binding, READ_ONLY],
            ),
        }
    }
}

/// A read-only storage buffer, also for frame uniforms.
///
/// From a uniform buffer, Mesa's lavapipe compiles the values that decide branches into the shader, anew
/// for each dispatch, and keeps every such shader. Seen with Mesa 22.3.6.
const READ_ONLY: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Storage { read_only: true },
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// The table of a [`SampledSky`](super::sky::SampledSky).
const SKY_TABLE: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Uint,
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};

const STORAGE: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Storage { read_only: false },
    has_dynamic_offset: false,
    min_binding_size: None,
};

const fn uniform(has_dynamic_offset: bool) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset,
        min_binding_size: None,
    }
}

const fn entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None }
}

/// The pipeline layout of these bind groups, in order.
pub(super) fn pipeline_layout(
    device: &wgpu::Device,
    label: &str,
    groups: &[&wgpu::BindGroupLayout],
) -> wgpu::PipelineLayout {
    let bind_group_layouts: Vec<_> = groups.iter().copied().map(Some).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &bind_group_layouts,
        immediate_size: 0,
    })
}
