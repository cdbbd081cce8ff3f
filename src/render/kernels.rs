//! The compute pipelines of one device, shared by every view on it.

use std::{
    collections::HashMap,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use super::pass;
use crate::gpu::{Gpu, shader::Module};

/// The bind group layouts that all passes of a picture share.
pub struct Layouts {
    /// Group 0: picture, slice (dynamic offset), lights, gradient; uniform but for the picture.
    pub picture: wgpu::BindGroupLayout,
    /// Group 1: surface, colour data, visibility; all storage.
    pub gbuffer: wgpu::BindGroupLayout,
    /// Group 1 of gathering: the same, read only.
    pub samples: wgpu::BindGroupLayout,
    /// Group 1 of the passes that see the film as a whole: statistics, mip levels, half blurred;
    /// all storage.
    pub glow: wgpu::BindGroupLayout,
    /// Group 2: the film's two halves, the display texture, direct light.
    pub film: wgpu::BindGroupLayout,
    /// Group 3 of shading: the picture of the surroundings and its sampler.
    pub backdrop: wgpu::BindGroupLayout,
    /// Group 3 of gathering: the same, and the neighbours' surface.
    pub around: wgpu::BindGroupLayout,
}

impl Layouts {
    fn new(device: &wgpu::Device) -> Self {
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
        let [backdrop_texture, backdrop_sampler] = super::backdrop::BINDINGS;
        Self {
            picture: group("picture", &[READ_ONLY, uniform(true), uniform(false), uniform(false)]),
            gbuffer: group("gbuffer", &[STORAGE; 3]),
            samples: group("samples", &[READ_ONLY; 3]),
            glow: group("glow", &[STORAGE; 3]),
            film: group("film", &[STORAGE, STORAGE, display, STORAGE]),
            backdrop: group("surroundings", &[backdrop_texture, backdrop_sampler]),
            around: group("neighbours", &[backdrop_texture, backdrop_sampler, READ_ONLY]),
        }
    }
}

/// The picture too, rather than uniform: Mesa's lavapipe puts the values of a uniform buffer that decide branches into
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

/// Makes one pipeline; `power` is the value of the `POWER` override where the module has it.
fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    label: &str,
    power: Option<u32>,
) -> wgpu::ComputePipeline {
    let constants: Vec<_> = power.iter().map(|&power| ("POWER", f64::from(power))).collect();
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..Default::default()
        },
        cache: None,
    })
}

/// The passes that evaluate the formula, for one power.
#[derive(Clone)]
pub struct Marchers {
    /// Camera rays to the G-buffer.
    pub march: wgpu::ComputePipeline,
    /// Depths to normals.
    pub normal: wgpu::ComputePipeline,
    /// Shadow rays to visibility bits.
    pub shadow: wgpu::ComputePipeline,
}

/// The passes that see the film as a whole.
pub struct GlowKernels {
    /// Film to the finest mip level.
    pub mean: wgpu::ComputePipeline,
    /// A mip level to the next.
    pub reduce: wgpu::ComputePipeline,
    /// Mean to exposure.
    pub expose: wgpu::ComputePipeline,
    /// Film to histogram.
    pub histogram: wgpu::ComputePipeline,
    /// What blooms, to the finest mip level.
    pub bloom: wgpu::ComputePipeline,
    /// One direction of a blur.
    pub blur: wgpu::ComputePipeline,
}

/// The pipelines that every picture needs, and those specialised so far.
pub struct Kernels {
    /// The device.
    pub gpu: Gpu,
    /// What bind groups look like.
    pub layouts: Layouts,
    /// Any power, whole or real: always ready.
    general: Marchers,
    /// One set for each whole power that has been asked for.
    special: Mutex<HashMap<u32, Marchers>>,
    march_module: wgpu::ShaderModule,
    normal_module: wgpu::ShaderModule,
    shadow_module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    /// Light and colour onto the film.
    pub shade: wgpu::ComputePipeline,
    /// Direct and indirect light onto the film: made when a scene first asks for it.
    gather: OnceLock<wgpu::ComputePipeline>,
    /// Pixels between those of a sparse lattice.
    pub fill: wgpu::ComputePipeline,
    /// Mean, histogram, bloom: made when a scene first asks for one of them.
    glow: OnceLock<GlowKernels>,
    glow_layout: wgpu::PipelineLayout,
    /// Film to display.
    pub tone: wgpu::ComputePipeline,
}

impl Kernels {
    /// Makes the pipelines that every picture needs. Specialised ones come with
    /// [`Self::specialise`].
    pub fn new(gpu: &Gpu) -> Arc<Self> {
        let device = &gpu.device;
        let layouts = Layouts::new(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("picture passes"),
            bind_group_layouts: &[
                Some(&layouts.picture),
                Some(&layouts.gbuffer),
                Some(&layouts.film),
            ],
            immediate_size: 0,
        });
        let shade_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shading"),
            bind_group_layouts: &[
                Some(&layouts.picture),
                Some(&layouts.gbuffer),
                Some(&layouts.film),
                Some(&layouts.backdrop),
            ],
            immediate_size: 0,
        });
        let glow_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("passes over the film as a whole"),
            bind_group_layouts: &[Some(&layouts.picture), Some(&layouts.glow), Some(&layouts.film)],
            immediate_size: 0,
        });
        let made = |layout: &wgpu::PipelineLayout, module: &Module| {
            pipeline(device, layout, &module.create(device), module.label, None)
        };
        let plain = |module| made(&layout, module);
        let march_module = pass::march::MODULE.create(device);
        let normal_module = pass::normal::MODULE.create(device);
        let shadow_module = pass::shadow::MODULE.create(device);
        let general = Marchers {
            march: pipeline(device, &layout, &march_module, "march", Some(0)),
            normal: pipeline(device, &layout, &normal_module, "normal", Some(0)),
            shadow: pipeline(device, &layout, &shadow_module, "shadow", Some(0)),
        };
        Arc::new(Self {
            gpu: gpu.clone(),
            general,
            special: Mutex::default(),
            shade: made(&shade_layout, &pass::shade::MODULE),
            gather: OnceLock::new(),
            fill: plain(&pass::fill::MODULE),
            glow: OnceLock::new(),
            tone: made(&glow_layout, &pass::tone::MODULE),
            march_module,
            normal_module,
            shadow_module,
            layout,
            glow_layout,
            layouts,
        })
    }

    /// The passes that see the film as a whole.
    pub fn glow(&self) -> &GlowKernels {
        self.glow.get_or_init(|| {
            let device = &self.gpu.device;
            let made = |module: &Module| {
                pipeline(device, &self.glow_layout, &module.create(device), module.label, None)
            };
            GlowKernels {
                mean: made(&pass::mean::MODULE),
                reduce: made(&pass::reduce::MODULE),
                expose: made(&pass::expose::MODULE),
                histogram: made(&pass::histogram::MODULE),
                bloom: made(&pass::bloom::MODULE),
                blur: made(&pass::blur::MODULE),
            }
        })
    }

    /// Direct and indirect light onto the film.
    pub fn gather(&self) -> &wgpu::ComputePipeline {
        self.gather.get_or_init(|| {
            let device = &self.gpu.device;
            let Layouts { picture, samples, film, around, .. } = &self.layouts;
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("gathering"),
                bind_group_layouts: &[Some(picture), Some(samples), Some(film), Some(around)],
                immediate_size: 0,
            });
            let module = &pass::gather::MODULE;
            pipeline(device, &layout, &module.create(device), module.label, None)
        })
    }

    /// The fastest pipelines that are ready for a power (0 where it isn't whole).
    pub fn marchers(&self, integer_power: u32) -> Marchers {
        self.lock().get(&integer_power).unwrap_or(&self.general).clone()
    }

    /// True where [`Self::specialise`] has nothing to do for this power.
    pub fn is_specialised(&self, integer_power: u32) -> bool {
        integer_power == 0 || self.lock().contains_key(&integer_power)
    }

    /// Compiles the pipelines of a whole power. This may take a second and blocks.
    pub fn specialise(&self, integer_power: u32) {
        if self.is_specialised(integer_power) {
            return;
        }
        let make = |module, label: &str| {
            let label = format!("{label}, power {integer_power}");
            pipeline(&self.gpu.device, &self.layout, module, &label, Some(integer_power))
        };
        let marchers = Marchers {
            march: make(&self.march_module, "march"),
            normal: make(&self.normal_module, "normal"),
            shadow: make(&self.shadow_module, "shadow"),
        };
        self.lock().insert(integer_power, marchers);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, HashMap<u32, Marchers>> {
        // Whole entries are inserted: the map is valid whatever interrupted its holder.
        self.special.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
