//! The compute pipelines of one device, shared by every view on it.

use std::{
    collections::{HashMap, HashSet},
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, atomic::AtomicBool},
};

use super::{
    Region,
    layouts::pipeline_layout,
    pass,
    uniforms::{FrameUniforms, Inputs},
};
pub use super::{
    layouts::Layouts,
    pipeline_key::{Depth, PipelineKey},
    post_pipelines::PostPipelines,
};
use crate::{
    gpu::{Gpu, device::in_parallel, shader::Module},
    scene::Scene,
};

/// Values of a module's overrides, by their names; those left out stay open, and the passes read
/// them from the picture.
pub type Constants = Vec<(&'static str, f64)>;

/// Makes one pipeline.
fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    label: &str,
    constants: &Constants,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
        cache: None,
    })
}

/// A pass in its general form, compiled when it is first asked for.
struct LazyPipeline {
    module: &'static Module,
    layout: wgpu::PipelineLayout,
    shader: OnceLock<wgpu::ShaderModule>,
    pipeline: OnceLock<wgpu::ComputePipeline>,
}

impl LazyPipeline {
    fn new(layout: &wgpu::PipelineLayout, module: &'static Module) -> Self {
        let (shader, pipeline) = (OnceLock::new(), OnceLock::new());
        Self { module, layout: layout.clone(), shader, pipeline }
    }

    fn shader(&self, device: &wgpu::Device) -> &wgpu::ShaderModule {
        self.shader.get_or_init(|| self.module.create(device))
    }

    fn pipeline(&self, pipelines: &Pipelines) -> wgpu::ComputePipeline {
        let make = || {
            let (device, label) = (&pipelines.gpu.device, self.module.label);
            locked(&pipelines.made).push(label.to_owned());
            pipeline(device, &self.layout, self.shader(device), label, &Constants::new())
        };
        self.pipeline.get_or_init(make).clone()
    }
}

/// A pass that any picture can have in its general form, and that is faster with some of the
/// picture's values compiled in: then there is nothing left to decide. (Where lanes disagree, and
/// always on lavapipe, all sides of a decision are computed.)
struct SpecializedPipeline {
    general: LazyPipeline,
    /// By what they are for, and which of its parts they are.
    made: Mutex<HashMap<(PipelineVariant, usize), wgpu::ComputePipeline>>,
}

impl SpecializedPipeline {
    fn new(layout: &wgpu::PipelineLayout, module: &'static Module) -> Self {
        Self { general: LazyPipeline::new(layout, module), made: Mutex::default() }
    }

    /// Its form for `variant`, or the general one until that is kept.
    fn of(
        &self,
        variant: PipelineVariant,
        part: usize,
        pipelines: &Pipelines,
    ) -> wgpu::ComputePipeline {
        if let Some(made) = locked(&self.made).get(&(variant, part)) {
            return made.clone();
        }
        self.general.pipeline(pipelines)
    }

    fn keep(&self, variant: PipelineVariant, part: usize, pipeline: wgpu::ComputePipeline) {
        locked(&self.made).entry((variant, part)).or_insert(pipeline);
    }
}

/// The passes of a picture that there are general and special forms of: the fastest that are ready.
#[derive(Clone)]
pub struct Passes {
    /// Bundles of camera rays to a list of those that may hit.
    pub camera_cone: wgpu::ComputePipeline,
    /// Camera rays to the G-buffer.
    pub march: wgpu::ComputePipeline,
    /// Depths to normals.
    pub normal: wgpu::ComputePipeline,
    /// Bundles of shadow rays to a list of those that are needed.
    pub shadow_cone: wgpu::ComputePipeline,
    /// Shadow rays to visibility bits.
    pub shadow: wgpu::ComputePipeline,
    /// Light and colour of single samples onto the film.
    pub shade: wgpu::ComputePipeline,
    /// The same of samples that are computed together.
    pub shade_together: wgpu::ComputePipeline,
    /// Film to display, where every pixel has its sample.
    pub tone: wgpu::ComputePipeline,
    /// The same for a sparse lattice.
    pub sparse_tone: wgpu::ComputePipeline,
}

/// What tone mapping is specialised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ToneForm {
    /// The tone curve, as the shaders count them.
    pub curve: u32,
    /// Whether there is bloom.
    pub blooms: bool,
    /// Whether both eyes are shown in one picture, red and cyan.
    pub is_anaglyph: bool,
}

/// Specialized and optional pipelines: compiled when a picture needs them or is faster with
/// them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PipelineVariant {
    /// Camera and shadow rays of a key.
    Rays(PipelineKey),
    /// Normals of one kind, as the shaders count them, of a key.
    Normals(PipelineKey, u32),
    /// Shading, with the environment map behind all or without.
    Shade(bool),
    /// Tone mapping.
    Tone(ToneForm),
    /// Indirect light.
    Indirect,
    /// Mean, histogram, bloom.
    Post,
}

impl PipelineVariant {
    /// Specialized variants of the passes of a picture.
    pub fn special(frame: &FrameUniforms) -> [Self; 4] {
        let key = PipelineKey::of(frame);
        let tone = ToneForm {
            curve: frame.tone.curve,
            blooms: frame.bloom.strength > 0.0,
            is_anaglyph: frame.eyes.anaglyph != 0,
        };
        [
            Self::Rays(key),
            Self::Normals(key, frame.normals),
            Self::Shade(frame.background.picture_gain > 0.0),
            Self::Tone(tone),
        ]
    }

    /// What they are for, in words that follow "Preparing".
    pub fn name(self) -> String {
        match self {
            Self::Rays(key) | Self::Normals(key, _) if key.is_deep() => "the deep zoom".to_owned(),
            Self::Rays(key) | Self::Normals(key, _) => format!("power {}", key.power),
            Self::Shade(_) => "light".to_owned(),
            Self::Tone(_) => "tone mapping".to_owned(),
            Self::Indirect => "indirect light".to_owned(),
            Self::Post => "exposure and bloom".to_owned(),
        }
    }

    /// How many pipelines they are.
    pub fn parts(self) -> usize {
        match self {
            Self::Rays(_) => 4,
            Self::Tone(_) | Self::Shade(_) => 2,
            Self::Normals(..) | Self::Indirect => 1,
            Self::Post => PostPipelines::PARTS.len(),
        }
    }

    /// The overrides that one of its parts sets.
    fn constants(self, part: usize) -> Constants {
        match self {
            Self::Rays(key) => key.constants(),
            Self::Normals(key, kind) => {
                let kind = ("NORMALS", f64::from(kind));
                key.constants().into_iter().chain([kind]).collect()
            }
            Self::Shade(has_environment_map) => {
                vec![
                    ("HAS_ENVIRONMENT_MAP", f64::from(has_environment_map)),
                    ("SINGLE", f64::from(part == 0)),
                ]
            }
            Self::Tone(ToneForm { curve, blooms, is_anaglyph }) => vec![
                ("CURVE", f64::from(curve)),
                ("BLOOM", f64::from(blooms)),
                ("ANAGLYPH", f64::from(is_anaglyph)),
                ("SPARSE", f64::from(part == 1)),
            ],
            Self::Indirect | Self::Post => Vec::new(),
        }
    }
}

/// Compute pipelines: those of every picture, and the [variants](PipelineVariant) compiled so far.
pub struct Pipelines {
    /// The device.
    pub gpu: Gpu,
    /// What bind groups look like.
    pub layouts: Layouts,
    camera_cone: SpecializedPipeline,
    march: SpecializedPipeline,
    compact_hits: LazyPipeline,
    normal: SpecializedPipeline,
    shadow_cone: SpecializedPipeline,
    shadow: SpecializedPipeline,
    shade: SpecializedPipeline,
    tone: SpecializedPipeline,
    indirect: OnceLock<wgpu::ComputePipeline>,
    fill: LazyPipeline,
    post: OnceLock<PostPipelines>,
    post_layout: wgpu::PipelineLayout,
    tonemap_sparse: LazyPipeline,
    upsample: LazyPipeline,
    /// Those that can be used without delay.
    ready: Mutex<HashSet<PipelineVariant>>,
    /// The labels of all pipelines so far.
    made: Mutex<Vec<String>>,
}

impl Pipelines {
    /// Makes the general forms of all passes, which draw whatever comes.
    pub fn new(gpu: &Gpu) -> Arc<Self> {
        let pipelines = Self::for_stills(gpu);
        let Self { camera_cone, march, normal, shadow_cone, shadow, shade, tone, .. } = &*pipelines;
        let specials = [camera_cone, march, normal, shadow_cone, shadow, shade, tone]
            .map(|special| &special.general);
        let Self { compact_hits, fill, tonemap_sparse, upsample, .. } = &*pipelines;
        for plain in specials.into_iter().chain([compact_hits, fill, tonemap_sparse, upsample]) {
            plain.pipeline(&pipelines);
        }
        pipelines
    }

    /// Makes nothing yet: stills have the special forms of their passes compiled before they begin, and
    /// need no others.
    pub fn for_stills(gpu: &Gpu) -> Arc<Self> {
        let device = &gpu.device;
        let layouts = Layouts::new(device);
        let Layouts { frame, gbuffer, dequeue, enqueue, film, post, environment_texture, .. } =
            &layouts;
        let enqueue_layout = pipeline_layout(device, "enqueue", &[frame, gbuffer, enqueue]);
        let dequeue_layout = pipeline_layout(device, "dequeue", &[frame, gbuffer, dequeue]);
        let layout = pipeline_layout(device, "picture passes", &[frame, gbuffer, film]);
        let shade_layout =
            pipeline_layout(device, "shading", &[frame, gbuffer, film, environment_texture]);
        let post_layout =
            pipeline_layout(device, "passes over the film as a whole", &[frame, post, film]);
        let camera_cone = SpecializedPipeline::new(&enqueue_layout, &pass::camera_cone::MODULE);
        let march = SpecializedPipeline::new(&dequeue_layout, &pass::march::MODULE);
        let normal = SpecializedPipeline::new(&dequeue_layout, &pass::normal::MODULE);
        let shadow_cone = SpecializedPipeline::new(&enqueue_layout, &pass::shadow_cone::MODULE);
        let shadow = SpecializedPipeline::new(&dequeue_layout, &pass::shadow::MODULE);
        let shade = SpecializedPipeline::new(&shade_layout, &pass::shade::MODULE);
        let tone = SpecializedPipeline::new(&post_layout, &pass::tone::MODULE);
        let compact_hits = LazyPipeline::new(&enqueue_layout, &pass::compact_hits::MODULE);
        let fill = LazyPipeline::new(&layout, &pass::fill::MODULE);
        let tonemap_sparse = LazyPipeline::new(&layout, &pass::tonemap_sparse::MODULE);
        let upsample = LazyPipeline::new(&layout, &pass::upsample::MODULE);
        Arc::new(Self {
            gpu: gpu.clone(),
            camera_cone,
            march,
            compact_hits,
            normal,
            shadow_cone,
            shadow,
            shade,
            tone,
            indirect: OnceLock::new(),
            fill,
            post: OnceLock::new(),
            tonemap_sparse,
            upsample,
            post_layout,
            layouts,
            ready: Mutex::default(),
            made: Mutex::default(),
        })
    }

    /// The passes that see the film as a whole; compiles them where nobody
    /// [prepared](Self::prepare) them.
    pub fn post(&self) -> &PostPipelines {
        self.post.get_or_init(|| {
            PostPipelines::from_parts(|part| self.make(PipelineVariant::Post, part))
        })
    }

    /// Direct and indirect light onto the film; compiles that where nobody
    /// [prepared](Self::prepare) it.
    pub fn indirect(&self) -> &wgpu::ComputePipeline {
        self.indirect.get_or_init(|| self.make(PipelineVariant::Indirect, 0))
    }

    /// The fastest forms of a picture's passes that are ready.
    pub fn passes(&self, frame: &FrameUniforms) -> Passes {
        let [rays, normals, light, tone] = PipelineVariant::special(frame);
        Passes {
            camera_cone: self.camera_cone.of(rays, 0, self),
            march: self.march.of(rays, 1, self),
            shadow_cone: self.shadow_cone.of(rays, 2, self),
            shadow: self.shadow.of(rays, 3, self),
            normal: self.normal.of(normals, 0, self),
            shade: self.shade.of(light, 0, self),
            shade_together: self.shade.of(light, 1, self),
            tone: self.tone.of(tone, 0, self),
            sparse_tone: self.tone.of(tone, 1, self),
        }
    }

    /// G-buffer to a list of its surface points.
    pub fn compact_hits(&self) -> wgpu::ComputePipeline {
        self.compact_hits.pipeline(self)
    }

    /// Pixels between those of a sparse lattice.
    pub fn fill(&self) -> wgpu::ComputePipeline {
        self.fill.pipeline(self)
    }

    /// Samples of a sparse lattice to display values.
    pub fn tonemap_sparse(&self) -> wgpu::ComputePipeline {
        self.tonemap_sparse.pipeline(self)
    }

    /// Those to the display.
    pub fn upsample(&self) -> wgpu::ComputePipeline {
        self.upsample.pipeline(self)
    }

    /// Whether [`Self::passes`] has rays of this form alone.
    pub fn has_own(&self, key: PipelineKey) -> bool {
        locked(&self.march.made).contains_key(&(PipelineVariant::Rays(key), 1))
    }

    /// Whether these can be used without delay.
    pub fn is_ready(&self, variant: PipelineVariant) -> bool {
        // Other powers have the general forms only.
        let general = PipelineKey { power: 0, depth: Depth::Plain };
        matches!(variant, PipelineVariant::Rays(key) | PipelineVariant::Normals(key, _) if key == general)
            || locked(&self.ready).contains(&variant)
    }

    /// Compiles what is missing of these. This may take a second and blocks.
    pub fn prepare(&self, variant: PipelineVariant) {
        if !self.is_ready(variant) {
            self.keep(variant, (0..variant.parts()).map(|part| self.make(variant, part)).collect());
            self.set_ready(variant);
        }
    }

    /// The same of several at once, on as many threads as the platform has for that.
    pub fn prepare_together(&self, extras: &[PipelineVariant]) {
        let parts: Vec<_> = extras
            .iter()
            .filter(|variant| !self.is_ready(**variant))
            .flat_map(|&variant| (0..variant.parts()).map(move |part| (variant, part)))
            .collect();
        let mut made = HashMap::<PipelineVariant, Vec<_>>::new();
        let made_in_order = in_parallel(&parts, |&(variant, part)| self.make(variant, part));
        for ((variant, _), pipeline) in parts.into_iter().zip(made_in_order) {
            made.entry(variant).or_default().push(pipeline);
        }
        for (variant, parts) in made {
            self.keep(variant, parts);
            self.set_ready(variant);
        }
    }

    /// Compiles all special forms of a scene's passes. This may take a second and blocks.
    pub fn specialise(&self, scene: &Scene) {
        let inputs = Inputs::new(scene, Region::whole([64, 64]));
        self.prepare_together(&PipelineVariant::special(&inputs.frame));
    }

    /// The passes that an extra has special forms of, in the order of its parts.
    fn special(&self, variant: PipelineVariant) -> Vec<&SpecializedPipeline> {
        match variant {
            PipelineVariant::Rays(_) => {
                vec![&self.camera_cone, &self.march, &self.shadow_cone, &self.shadow]
            }
            PipelineVariant::Normals(..) => vec![&self.normal],
            PipelineVariant::Shade(_) => vec![&self.shade, &self.shade],
            PipelineVariant::Tone(_) => vec![&self.tone, &self.tone],
            PipelineVariant::Indirect | PipelineVariant::Post => Vec::new(),
        }
    }

    /// Starts to compile one pipeline asynchronously, `part` of as many as there are
    /// [parts](PipelineVariant::parts), for [`Self::make`] to have it at once when the flag is true; none
    /// where pipelines cannot be compiled asynchronously.
    pub(super) fn begin(&self, variant: PipelineVariant, part: usize) -> Option<Arc<AtomicBool>> {
        let compile = self.gpu.async_compile?;
        Some((compile.begin)(&self.gpu.device, &mut || drop(self.ask(variant, part))))
    }

    /// Makes one pipeline, `part` of as many as there are [parts](PipelineVariant::parts). For
    /// [`Self::keep`].
    pub(super) fn make(&self, variant: PipelineVariant, part: usize) -> wgpu::ComputePipeline {
        let mut made = None;
        if let Some(compile) = self.gpu.async_compile {
            (compile.take)(&self.gpu.device, &mut || made = Some(self.ask(variant, part)));
        }
        let (label, pipeline) = made.unwrap_or_else(|| self.ask(variant, part));
        locked(&self.made).push(label);
        pipeline
    }

    /// Asks the device for one pipeline; its label and what the device gives.
    fn ask(&self, variant: PipelineVariant, part: usize) -> (String, wgpu::ComputePipeline) {
        let device = &self.gpu.device;
        let plain = |layout: &wgpu::PipelineLayout, module: &Module| {
            let shader = module.create(device);
            (module.label.to_owned(), pipeline(device, layout, &shader, module.label, &Vec::new()))
        };
        match variant {
            PipelineVariant::Indirect => {
                let Layouts { frame, samples, film, indirect, .. } = &self.layouts;
                let groups = [frame, samples, film, indirect];
                plain(&pipeline_layout(device, "indirect", &groups), &pass::indirect::MODULE)
            }
            PipelineVariant::Post => plain(&self.post_layout, PostPipelines::PARTS[part]),
            _ => {
                let LazyPipeline { module, layout, .. } = &self.special(variant)[part].general;
                let shader = self.special(variant)[part].general.shader(device);
                let label = module.label;
                let constants = variant.constants(part);
                let values = constants.iter().map(|(name, value)| format!(", {name} {value}"));
                let label = format!("{label}{}", values.collect::<String>());
                let pipeline = pipeline(device, layout, shader, &label, &constants);
                (label, pipeline)
            }
        }
    }

    /// Takes all parts of these, in order. Where somebody else was faster, theirs stay.
    pub(super) fn keep(&self, variant: PipelineVariant, parts: Vec<wgpu::ComputePipeline>) {
        let part = |index: usize| parts[index].clone();
        match variant {
            PipelineVariant::Indirect => {
                self.indirect.get_or_init(|| part(0));
            }
            PipelineVariant::Post => {
                self.post.get_or_init(|| PostPipelines::from_parts(part));
            }
            _ => {
                for (part, pipeline) in parts.into_iter().enumerate() {
                    self.special(variant)[part].keep(variant, part, pipeline);
                }
            }
        }
    }

    /// Says that these are kept and have been used once.
    pub(super) fn set_ready(&self, variant: PipelineVariant) {
        locked(&self.ready).insert(variant);
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
