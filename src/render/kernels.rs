//! The compute pipelines of one device, shared by every view on it.

use std::{
    collections::{HashMap, HashSet},
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, atomic::AtomicBool},
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

fn pipeline_layout(
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

/// Makes one pipeline, with the value of an override where the module has one.
fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    label: &str,
    constant: Option<(&str, f64)>,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: constant.as_slice(),
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

impl Marchers {
    /// Their names and modules, in the order of the fields.
    const PARTS: [&Module; 3] =
        [&pass::march::MODULE, &pass::normal::MODULE, &pass::shadow::MODULE];

    /// Those of one power, made by `part` from their places in [`Self::PARTS`].
    fn from_parts(mut part: impl FnMut(usize) -> wgpu::ComputePipeline) -> Self {
        Self { march: part(0), normal: part(1), shadow: part(2) }
    }
}

/// Pipelines beyond those that every picture needs: made when one needs them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extra {
    /// A whole power's own, faster than the general ones.
    Power(u32),
    /// Indirect light.
    Gather,
    /// Mean, histogram, bloom.
    Glow,
}

impl Extra {
    /// What they are for, in words that follow "Preparing".
    pub fn name(self) -> String {
        match self {
            Self::Power(power) => format!("power {power}"),
            Self::Gather => "indirect light".to_owned(),
            Self::Glow => "exposure and bloom".to_owned(),
        }
    }

    /// How many pipelines they are.
    pub fn parts(self) -> usize {
        match self {
            Self::Power(_) => Marchers::PARTS.len(),
            Self::Gather => 1,
            Self::Glow => GlowKernels::PARTS.len(),
        }
    }
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

impl GlowKernels {
    /// Their names and modules, in the order of the fields.
    const PARTS: [&Module; 6] = [
        &pass::mean::MODULE,
        &pass::reduce::MODULE,
        &pass::expose::MODULE,
        &pass::histogram::MODULE,
        &pass::bloom::MODULE,
        &pass::blur::MODULE,
    ];

    /// All of them, made by `part` from their places in [`Self::PARTS`].
    fn from_parts(mut part: impl FnMut(usize) -> wgpu::ComputePipeline) -> Self {
        Self {
            mean: part(0),
            reduce: part(1),
            expose: part(2),
            histogram: part(3),
            bloom: part(4),
            blur: part(5),
        }
    }
}

/// The pipelines that every picture needs, and the [extra](Extra) ones made so far.
pub struct Kernels {
    /// The device.
    pub gpu: Gpu,
    /// What bind groups look like.
    pub layouts: Layouts,
    /// Any power, whole or real: always ready.
    general: Marchers,
    /// One set for each whole power that has been asked for.
    special: Mutex<HashMap<u32, Marchers>>,
    march_modules: [wgpu::ShaderModule; Marchers::PARTS.len()],
    layout: wgpu::PipelineLayout,
    /// Light and colour onto the film.
    pub shade: wgpu::ComputePipeline,
    gather: OnceLock<wgpu::ComputePipeline>,
    /// Pixels between those of a sparse lattice.
    pub fill: wgpu::ComputePipeline,
    glow: OnceLock<GlowKernels>,
    glow_layout: wgpu::PipelineLayout,
    /// Film to display.
    pub tone: wgpu::ComputePipeline,
    /// The same for one eye, without bloom, by Reinhard's curve.
    pub tone_plain: wgpu::ComputePipeline,
    /// Samples of a sparse lattice to display values.
    pub develop: wgpu::ComputePipeline,
    /// Those to the display.
    pub spread: wgpu::ComputePipeline,
    /// Those that can be used without delay.
    ready: Mutex<HashSet<Extra>>,
    /// The labels of all pipelines so far.
    made: Mutex<Vec<String>>,
}

impl Kernels {
    /// Makes the pipelines that every picture needs.
    pub fn new(gpu: &Gpu) -> Arc<Self> {
        let device = &gpu.device;
        let layouts = Layouts::new(device);
        let Layouts { picture, gbuffer, film, glow, backdrop, .. } = &layouts;
        let layout = pipeline_layout(device, "picture passes", &[picture, gbuffer, film]);
        let shade_layout = pipeline_layout(device, "shading", &[picture, gbuffer, film, backdrop]);
        let glow_layout =
            pipeline_layout(device, "passes over the film as a whole", &[picture, glow, film]);
        let mut labels = Vec::new();
        let mut made = |layout: &wgpu::PipelineLayout, module: &Module| {
            labels.push(module.label.to_owned());
            pipeline(device, layout, &module.create(device), module.label, None)
        };
        let shade = made(&shade_layout, &pass::shade::MODULE);
        let fill = made(&layout, &pass::fill::MODULE);
        let develop = made(&layout, &pass::develop::MODULE);
        let spread = made(&layout, &pass::spread::MODULE);
        let tone = made(&glow_layout, &pass::tone::MODULE);
        let plain = Some(("PLAIN", 1.0));
        let tone_module = pass::tone::MODULE.create(device);
        let tone_plain = pipeline(device, &glow_layout, &tone_module, "tone, plain", plain);
        labels.push("tone, plain".to_owned());
        let march_modules = Marchers::PARTS.map(|module| module.create(device));
        let general = Marchers::from_parts(|part| {
            let label = Marchers::PARTS[part].label;
            labels.push(label.to_owned());
            pipeline(device, &layout, &march_modules[part], label, Some(("POWER", 0.0)))
        });
        Arc::new(Self {
            gpu: gpu.clone(),
            general,
            special: Mutex::default(),
            shade,
            gather: OnceLock::new(),
            fill,
            glow: OnceLock::new(),
            tone,
            tone_plain,
            develop,
            spread,
            march_modules,
            layout,
            glow_layout,
            layouts,
            ready: Mutex::default(),
            made: Mutex::new(labels),
        })
    }

    /// The passes that see the film as a whole; compiles them where nobody
    /// [prepared](Self::prepare) them.
    pub fn glow(&self) -> &GlowKernels {
        self.glow.get_or_init(|| GlowKernels::from_parts(|part| self.make(Extra::Glow, part)))
    }

    /// Direct and indirect light onto the film; compiles that where nobody
    /// [prepared](Self::prepare) it.
    pub fn gather(&self) -> &wgpu::ComputePipeline {
        self.gather.get_or_init(|| self.make(Extra::Gather, 0))
    }

    /// The fastest pipelines that are ready for a power (0 where it isn't whole).
    pub fn marchers(&self, integer_power: u32) -> Marchers {
        locked(&self.special).get(&integer_power).unwrap_or(&self.general).clone()
    }

    /// Whether [`Self::marchers`] has a set for this power alone.
    pub fn has_own(&self, integer_power: u32) -> bool {
        locked(&self.special).contains_key(&integer_power)
    }

    /// Whether these can be used without delay.
    pub fn is_ready(&self, extra: Extra) -> bool {
        extra == Extra::Power(0) || locked(&self.ready).contains(&extra)
    }

    /// Compiles what is missing of these. This may take a second and blocks.
    pub fn prepare(&self, extra: Extra) {
        if !self.is_ready(extra) {
            self.keep(extra, (0..extra.parts()).map(|part| self.make(extra, part)).collect());
            self.set_ready(extra);
        }
    }

    /// Compiles the pipelines of a whole power. This may take a second and blocks.
    pub fn specialise(&self, integer_power: u32) {
        self.prepare(Extra::Power(integer_power));
    }

    /// Starts to compile one pipeline aside, `part` of as many as there are
    /// [parts](Extra::parts), for [`Self::make`] to have it at once when the flag is true; none
    /// where pipelines cannot be compiled aside.
    pub(super) fn begin(&self, extra: Extra, part: usize) -> Option<Arc<AtomicBool>> {
        let aside = self.gpu.aside?;
        Some((aside.begin)(&self.gpu.device, &mut || drop(self.ask(extra, part))))
    }

    /// Makes one pipeline, `part` of as many as there are [parts](Extra::parts). For
    /// [`Self::keep`].
    pub(super) fn make(&self, extra: Extra, part: usize) -> wgpu::ComputePipeline {
        let mut made = None;
        if let Some(aside) = self.gpu.aside {
            (aside.take)(&self.gpu.device, &mut || made = Some(self.ask(extra, part)));
        }
        let (label, pipeline) = made.unwrap_or_else(|| self.ask(extra, part));
        locked(&self.made).push(label);
        pipeline
    }

    /// Asks the device for one pipeline; its label and what the device gives.
    fn ask(&self, extra: Extra, part: usize) -> (String, wgpu::ComputePipeline) {
        let device = &self.gpu.device;
        match extra {
            Extra::Power(power) => {
                let label = format!("{}, power {power}", Marchers::PARTS[part].label);
                let module = &self.march_modules[part];
                let pipeline = pipeline(
                    device,
                    &self.layout,
                    module,
                    &label,
                    Some(("POWER", f64::from(power))),
                );
                (label, pipeline)
            }
            Extra::Gather => {
                let Layouts { picture, samples, film, around, .. } = &self.layouts;
                let groups = [picture, samples, film, around];
                let layout = pipeline_layout(device, "gathering", &groups);
                let module = &pass::gather::MODULE;
                let pipeline =
                    pipeline(device, &layout, &module.create(device), module.label, None);
                (module.label.to_owned(), pipeline)
            }
            Extra::Glow => {
                let module = GlowKernels::PARTS[part];
                let layout = &self.glow_layout;
                let pipeline = pipeline(device, layout, &module.create(device), module.label, None);
                (module.label.to_owned(), pipeline)
            }
        }
    }

    /// Takes all parts of these, in order. Where somebody else was faster, theirs stay.
    pub(super) fn keep(&self, extra: Extra, parts: Vec<wgpu::ComputePipeline>) {
        let part = |index: usize| parts[index].clone();
        match extra {
            Extra::Power(power) => {
                locked(&self.special).entry(power).or_insert_with(|| Marchers::from_parts(part));
            }
            Extra::Gather => {
                self.gather.get_or_init(|| part(0));
            }
            Extra::Glow => {
                self.glow.get_or_init(|| GlowKernels::from_parts(part));
            }
        }
    }

    /// Says that these are kept and have been used once.
    pub(super) fn set_ready(&self, extra: Extra) {
        locked(&self.ready).insert(extra);
    }

    /// The labels of all pipelines made so far, in that order.
    pub fn made(&self) -> Vec<String> {
        locked(&self.made).clone()
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Whole entries are inserted: the collection is valid whatever interrupted its holder.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
