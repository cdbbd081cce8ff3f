//! What the passes bind, and in which groups: bind group layouts.

/// The bind group layouts that all passes of a picture share.
pub struct Layouts {
    /// Group 0: frame uniforms (a storage buffer), the anchor's orbit, slice (dynamic offset), lights,
    /// gradient.
    pub frame: wgpu::BindGroupLayout,
    /// Group 1: surface, colour data, visibility; all storage.
    pub gbuffer: wgpu::BindGroupLayout,
    /// Group 1 of the indirect pass: the same, read only.
    pub samples: wgpu::BindGroupLayout,
    /// Group 1 of the passes that see the film as a whole: statistics, mip levels, half blurred;
    /// all storage.
    pub post: wgpu::BindGroupLayout,
    /// Group 2 of passes that read a work queue: the queues.
    pub dequeue: wgpu::BindGroupLayout,
    /// Group 2 of passes that write them: the same, and the workgroups of those that read them.
    pub enqueue: wgpu::BindGroupLayout,
    /// Group 2: the film's two halves, the display texture, direct light.
    pub film: wgpu::BindGroupLayout,
    /// Group 3 of shading: the environment map and its sampler.
    pub environment_texture: wgpu::BindGroupLayout,
    /// Group 3 of the indirect pass: the same, and the surface of the indirect source.
    pub indirect: wgpu::BindGroupLayout,
}

impl Layouts {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let group = |label, kinds: &[wgpu::BindingType]| {
            let entries: Vec<_> = (0..).zip(kinds).map(|(i, kind)| entry(i, *kind)).collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        };
        let display = wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: super::targets::DISPLAY_FORMAT,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        let [environment_texture_binding, environment_sampler_binding] =
            super::environment_texture::BINDINGS;
        Self {
            frame: group(
                "frame",
                &[READ_ONLY, uniform(false), uniform(true), uniform(false), uniform(false)],
            ),
            gbuffer: group("gbuffer", &[STORAGE; 3]),
            samples: group("samples", &[READ_ONLY; 3]),
            post: group("post", &[STORAGE; 3]),
            dequeue: group("dequeue", &[STORAGE]),
            enqueue: group("enqueue", &[STORAGE; 2]),
            film: group("film", &[STORAGE, STORAGE, display, STORAGE]),
            environment_texture: group(
                "environment map",
                &[environment_texture_binding, environment_sampler_binding],
            ),
            indirect: group(
                "indirect source",
                &[environment_texture_binding, environment_sampler_binding, READ_ONLY],
            ),
        }
    }
}

/// Frame uniforms too, rather than a uniform buffer: Mesa's lavapipe puts the values of a uniform buffer that decide branches into
/// the shader, anew for each dispatch, and keeps every shader so made. Seen with Mesa 22.3.6.
const READ_ONLY: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Storage { read_only: true },
    has_dynamic_offset: false,
    min_binding_size: None,
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

/// What a pipeline binds, by its bind groups' layouts in order.
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
