//! The compute pipelines of one device, shared by every view on it.

use std::{
    collections::{HashMap, HashSet},
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, atomic::AtomicBool},
};

use super::{Region, layouts::pipeline_layout, pass, uniforms::Picture};
pub use super::{
    form::{Depth, Form},
    layouts::Layouts,
};
use crate::{
    gpu::{Gpu, shader::Module},
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

/// A pass that any picture can have in its general form, and that is faster with some of the
/// picture's values compiled in: then there is nothing left to decide. (Where lanes disagree, and
/// always on lavapipe, all sides of a decision are computed.)
struct Special {
    label: &'static str,
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    general: wgpu::ComputePipeline,
    /// By what they are for, and which of its parts they are.
    made: Mutex<HashMap<(Extra, usize), wgpu::ComputePipeline>>,
}

impl Special {
    fn new(device: &wgpu::Device, layout: &wgpu::PipelineLayout, module: &Module) -> Self {
        let shader = module.create(device);
        Self {
            label: module.label,
            general: pipeline(device, layout, &shader, module.label, &Constants::new()),
            module: shader,
            layout: layout.clone(),
            made: Mutex::default(),
        }
    }

    /// Its form for `extra`, or the general one until that is kept.
    fn of(&self, extra: Extra, part: usize) -> wgpu::ComputePipeline {
        locked(&self.made).get(&(extra, part)).unwrap_or(&self.general).clone()
    }

    fn keep(&self, extra: Extra, part: usize, pipeline: wgpu::ComputePipeline) {
        locked(&self.made).entry((extra, part)).or_insert(pipeline);
    }
}

/// The passes of a picture that there are general and special forms of: the fastest that are ready.
#[derive(Clone)]
pub struct Passes {
    /// Bundles of camera rays to a list of those that may hit.
    pub cone: wgpu::ComputePipeline,
    /// Camera rays to the G-buffer.
    pub march: wgpu::ComputePipeline,
    /// Depths to normals.
    pub normal: wgpu::ComputePipeline,
    /// Bundles of shadow rays to a list of those that are needed.
    pub tube: wgpu::ComputePipeline,
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

/// Pipelines beyond those that every picture needs: made when one needs them, or is faster with
/// them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extra {
    /// Rays of one form.
    Rays(Form),
    /// Normals of one kind, as the shaders count them, for one form.
    Normals(Form, u32),
    /// Shading, with the picture of the surroundings behind all or without.
    Shade(bool),
    /// Tone mapping.
    Tone(ToneForm),
    /// Indirect light.
    Gather,
    /// Mean, histogram, bloom.
    Glow,
}

impl Extra {
    /// The special forms of a picture's passes.
    pub fn special(picture: &Picture) -> [Self; 4] {
        let form = Form::of(picture);
        let tone = ToneForm {
            curve: picture.tone.curve,
            blooms: picture.bloom.strength > 0.0,
            is_anaglyph: picture.eyes.anaglyph != 0,
        };
        [
            Self::Rays(form),
            Self::Normals(form, picture.normals),
            Self::Shade(picture.background.picture_gain > 0.0),
            Self::Tone(tone),
        ]
    }

    /// What they are for, in words that follow "Preparing".
    pub fn name(self) -> String {
        match self {
            Self::Rays(form) | Self::Normals(form, _) if form.is_deep() => {
                "the deep zoom".to_owned()
            }
            Self::Rays(form) | Self::Normals(form, _) => format!("power {}", form.power),
            Self::Shade(_) => "light".to_owned(),
            Self::Tone(_) => "tone mapping".to_owned(),
            Self::Gather => "indirect light".to_owned(),
            Self::Glow => "exposure and bloom".to_owned(),
        }
    }

    /// How many pipelines they are.
    pub fn parts(self) -> usize {
        match self {
            Self::Rays(_) => 4,
            Self::Tone(_) | Self::Shade(_) => 2,
            Self::Normals(..) | Self::Gather => 1,
            Self::Glow => GlowKernels::PARTS.len(),
        }
    }

    /// The overrides that one of its parts sets.
    fn constants(self, part: usize) -> Constants {
        match self {
            Self::Rays(form) => form.constants(),
            Self::Normals(form, kind) => {
                let kind = ("NORMALS", f64::from(kind));
                form.constants().into_iter().chain([kind]).collect()
            }
            Self::Shade(has_backdrop) => {
                vec![("BACKDROP", f64::from(has_backdrop)), ("SINGLE", f64::from(part == 0))]
            }
            Self::Tone(ToneForm { curve, blooms, is_anaglyph }) => vec![
                ("CURVE", f64::from(curve)),
                ("BLOOM", f64::from(blooms)),
                ("ANAGLYPH", f64::from(is_anaglyph)),
                ("SPARSE", f64::from(part == 1)),
            ],
            Self::Gather | Self::Glow => Vec::new(),
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
    cone: Special,
    march: Special,
    /// G-buffer to a list of its surface points.
    pub hits: wgpu::ComputePipeline,
    normal: Special,
    tube: Special,
    shadow: Special,
    shade: Special,
    tone: Special,
    gather: OnceLock<wgpu::ComputePipeline>,
    /// Pixels between those of a sparse lattice.
    pub fill: wgpu::ComputePipeline,
    glow: OnceLock<GlowKernels>,
    glow_layout: wgpu::PipelineLayout,
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
        let Layouts { picture, gbuffer, listed, listing, film, glow, backdrop, .. } = &layouts;
        let listing_layout = pipeline_layout(device, "listing", &[picture, gbuffer, listing]);
        let listed_layout = pipeline_layout(device, "listed", &[picture, gbuffer, listed]);
        let layout = pipeline_layout(device, "picture passes", &[picture, gbuffer, film]);
        let shade_layout = pipeline_layout(device, "shading", &[picture, gbuffer, film, backdrop]);
        let glow_layout =
            pipeline_layout(device, "passes over the film as a whole", &[picture, glow, film]);
        let mut labels = Vec::new();
        let mut special = |layout: &wgpu::PipelineLayout, module: &Module| {
            labels.push(module.label.to_owned());
            Special::new(device, layout, module)
        };
        let cone = special(&listing_layout, &pass::cone::MODULE);
        let march = special(&listed_layout, &pass::march::MODULE);
        let normal = special(&listed_layout, &pass::normal::MODULE);
        let tube = special(&listing_layout, &pass::tube::MODULE);
        let shadow = special(&listed_layout, &pass::shadow::MODULE);
        let shade = special(&shade_layout, &pass::shade::MODULE);
        let tone = special(&glow_layout, &pass::tone::MODULE);
        let mut plain = |layout: &wgpu::PipelineLayout, module: &Module| {
            labels.push(module.label.to_owned());
            let shader = module.create(device);
            pipeline(device, layout, &shader, module.label, &Constants::new())
        };
        let hits = plain(&listing_layout, &pass::hits::MODULE);
        let fill = plain(&layout, &pass::fill::MODULE);
        let develop = plain(&layout, &pass::develop::MODULE);
        let spread = plain(&layout, &pass::spread::MODULE);
        Arc::new(Self {
            gpu: gpu.clone(),
            cone,
            march,
            hits,
            normal,
            tube,
            shadow,
            shade,
            tone,
            gather: OnceLock::new(),
            fill,
            glow: OnceLock::new(),
            develop,
            spread,
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

    /// The fastest forms of a picture's passes that are ready.
    pub fn passes(&self, picture: &Picture) -> Passes {
        let [rays, normals, light, tone] = Extra::special(picture);
        Passes {
            cone: self.cone.of(rays, 0),
            march: self.march.of(rays, 1),
            tube: self.tube.of(rays, 2),
            shadow: self.shadow.of(rays, 3),
            normal: self.normal.of(normals, 0),
            shade: self.shade.of(light, 0),
            shade_together: self.shade.of(light, 1),
            tone: self.tone.of(tone, 0),
            sparse_tone: self.tone.of(tone, 1),
        }
    }

    /// Whether [`Self::passes`] has rays of this form alone.
    pub fn has_own(&self, form: Form) -> bool {
        locked(&self.march.made).contains_key(&(Extra::Rays(form), 1))
    }

    /// Whether these can be used without delay.
    pub fn is_ready(&self, extra: Extra) -> bool {
        // Other powers have the general forms only.
        let general = Form { power: 0, depth: Depth::Plain };
        matches!(extra, Extra::Rays(form) | Extra::Normals(form, _) if form == general)
            || locked(&self.ready).contains(&extra)
    }

    /// Compiles what is missing of these. This may take a second and blocks.
    pub fn prepare(&self, extra: Extra) {
        if !self.is_ready(extra) {
            self.keep(extra, (0..extra.parts()).map(|part| self.make(extra, part)).collect());
            self.set_ready(extra);
        }
    }

    /// Compiles all special forms of a scene's passes. This may take a second and blocks.
    pub fn specialise(&self, scene: &Scene) {
        for extra in Extra::special(&Picture::new(scene, Region::whole([64, 64]))) {
            self.prepare(extra);
        }
    }

    /// The passes that an extra has special forms of, in the order of its parts.
    fn special(&self, extra: Extra) -> Vec<&Special> {
        match extra {
            Extra::Rays(_) => vec![&self.cone, &self.march, &self.tube, &self.shadow],
            Extra::Normals(..) => vec![&self.normal],
            Extra::Shade(_) => vec![&self.shade, &self.shade],
            Extra::Tone(_) => vec![&self.tone, &self.tone],
            Extra::Gather | Extra::Glow => Vec::new(),
        }
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
        let plain = |layout: &wgpu::PipelineLayout, module: &Module| {
            let shader = module.create(device);
            (module.label.to_owned(), pipeline(device, layout, &shader, module.label, &Vec::new()))
        };
        match extra {
            Extra::Gather => {
                let Layouts { picture, samples, film, around, .. } = &self.layouts;
                let groups = [picture, samples, film, around];
                plain(&pipeline_layout(device, "gathering", &groups), &pass::gather::MODULE)
            }
            Extra::Glow => plain(&self.glow_layout, GlowKernels::PARTS[part]),
            _ => {
                let Special { label, module, layout, .. } = self.special(extra)[part];
                let constants = extra.constants(part);
                let values = constants.iter().map(|(name, value)| format!(", {name} {value}"));
                let label = format!("{label}{}", values.collect::<String>());
                let pipeline = pipeline(device, layout, module, &label, &constants);
                (label, pipeline)
            }
        }
    }

    /// Takes all parts of these, in order. Where somebody else was faster, theirs stay.
    pub(super) fn keep(&self, extra: Extra, parts: Vec<wgpu::ComputePipeline>) {
        let part = |index: usize| parts[index].clone();
        match extra {
            Extra::Gather => {
                self.gather.get_or_init(|| part(0));
            }
            Extra::Glow => {
                self.glow.get_or_init(|| GlowKernels::from_parts(part));
            }
            _ => {
                for (part, pipeline) in parts.into_iter().enumerate() {
                    self.special(extra)[part].keep(extra, part, pipeline);
                }
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
