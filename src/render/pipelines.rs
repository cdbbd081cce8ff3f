//! The compute pipelines of one device, which all its views share.

use std::{
    collections::{HashMap, HashSet},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

pub use super::{
    layouts::Layouts,
    pipeline_set::{PipelineSet, PipelineVariant},
};
use super::{
    layouts::pipeline_layout,
    pass::{self, Pass},
    pipeline_set,
    recorder::PipelineSource,
    region::Region,
    shaders,
    uniforms::Inputs,
};
use crate::{
    formula::FormulaRef,
    gpu::{Gpu, device::in_parallel},
    scene::Scene,
};

/// One pipeline: a pass, a mode of the pass, a variant of the pass's set.
type PipelineId = (&'static str, usize, PipelineVariant);

/// Compute pipelines: every [variant](PipelineVariant) compiled so far.
pub struct Pipelines {
    /// The device.
    pub gpu: Gpu,
    /// The bind group layouts.
    pub layouts: Layouts,
    compiled: Mutex<HashMap<PipelineId, wgpu::ComputePipeline>>,
    /// Flags of asynchronous compilations whose pipelines are not taken yet, by variant and part.
    begun: Mutex<HashMap<(PipelineVariant, usize), Arc<AtomicBool>>>,
    /// Shader modules by pass and by the names of their files.
    shaders: Mutex<HashMap<(&'static str, Vec<&'static str>), wgpu::ShaderModule>>,
    /// Variants that are compiled and have been used once.
    ready: Mutex<HashSet<PipelineVariant>>,
    /// The labels of all compiled pipelines, in order.
    made: Mutex<Vec<String>>,
}

impl Pipelines {
    /// Compiles the general variants that every picture of the first formula needs.
    pub fn new(gpu: &Gpu) -> Arc<Self> {
        let pipelines = Self::for_stills(gpu);
        for pass in pass::all().filter(|pass| pass.set.is_always_needed) {
            let general = PipelineVariant::general_of(pass.set, FormulaRef::default());
            // A general pipeline serves every mode.
            pipelines.pipeline(pass, 0, &general);
            pipelines.set_ready(&general);
        }
        pipelines
    }

    /// Pipelines for stills: compiles nothing yet.
    ///
    /// A still compiles the special variants of its passes before it begins, and needs no others.
    pub fn for_stills(gpu: &Gpu) -> Arc<Self> {
        Arc::new(Self {
            gpu: gpu.clone(),
            layouts: Layouts::new(gpu),
            compiled: Mutex::default(),
            begun: Mutex::default(),
            shaders: Mutex::default(),
            ready: Mutex::default(),
            made: Mutex::default(),
        })
    }

    /// The fastest compiled pipelines of a frame's passes.
    pub fn of_frame(&self, inputs: &Inputs) -> FramePipelines<'_> {
        FramePipelines {
            pipelines: self,
            special: pipeline_set::specialized(inputs),
            formula: inputs.formula.kernel.formula,
            replaced: HashMap::new(),
        }
    }

    /// The pipeline of `pass` for `variant`, or for the general variant until that is compiled.
    ///
    /// Compiles the general pipeline if it is missing.
    fn pipeline(
        &self,
        pass: &'static Pass,
        mode: usize,
        variant: &PipelineVariant,
    ) -> wgpu::ComputePipeline {
        if let Some(special) = self.compiled(pass, mode, variant) {
            return special;
        }
        let general = variant.general().unwrap_or_else(|| variant.clone());
        let mode = if general.is_general() { 0 } else { mode };
        let made = self.compiled(pass, mode, &general);
        made.unwrap_or_else(|| {
            let (label, pipeline) = self.compile(pass, mode, &general);
            locked(&self.made).push(label);
            let id = (pass.name, mode, general);
            locked(&self.compiled).entry(id).or_insert(pipeline).clone()
        })
    }

    fn compiled(
        &self,
        pass: &Pass,
        mode: usize,
        variant: &PipelineVariant,
    ) -> Option<wgpu::ComputePipeline> {
        locked(&self.compiled).get(&(pass.name, mode, variant.clone())).cloned()
    }

    /// Whether all pipelines of `variant` itself are compiled.
    pub fn has_own(&self, variant: &PipelineVariant) -> bool {
        parts(variant).all(|(pass, mode)| self.compiled(pass, mode, variant).is_some())
    }

    /// Whether `variant` can be used without delay.
    pub fn is_ready(&self, variant: &PipelineVariant) -> bool {
        locked(&self.ready).contains(variant)
    }

    /// Compiles the missing pipelines of `variant`. This may take a second and blocks.
    pub fn prepare(&self, variant: &PipelineVariant) {
        self.prepare_together(std::slice::from_ref(variant));
    }

    /// Compiles the missing pipelines of several variants, on as many threads as the platform has.
    pub fn prepare_together(&self, variants: &[PipelineVariant]) {
        let missing: Vec<_> = variants.iter().filter(|variant| !self.is_ready(variant)).collect();
        let ids: Vec<_> = missing
            .iter()
            .flat_map(|variant| (0..part_count(variant)).map(move |part| (*variant, part)))
            .collect();
        let mut made = in_parallel(&ids, |&(variant, part)| self.make(variant, part)).into_iter();
        for variant in missing {
            self.keep(variant, made.by_ref().take(part_count(variant)).collect());
            self.set_ready(variant);
        }
    }

    /// Compiles all special variants for a scene. This may take a second and blocks.
    pub fn specialize(&self, scene: &Scene) {
        let inputs = Inputs::new(scene, Region::whole([64, 64]));
        self.prepare_together(&pipeline_set::specialized(&inputs));
    }

    /// Starts to compile one pipeline asynchronously, `part` of [`part_count`], unless a view has begun it already.
    ///
    /// Once the flag is true, [`Self::make`] has the pipeline at once. None where the platform cannot compile
    /// asynchronously.
    pub(super) fn begin(&self, variant: &PipelineVariant, part: usize) -> Option<Arc<AtomicBool>> {
        let compile = self.gpu.async_compile?;
        let mut begun = locked(&self.begun);
        let flag = begun.entry((variant.clone(), part)).or_insert_with(|| {
            (compile.begin)(&self.gpu.device, &mut || drop(self.ask(variant, part)))
        });
        Some(flag.clone())
    }

    /// Number of pipelines that are being compiled asynchronously, for all views.
    pub(super) fn under_way(&self) -> usize {
        locked(&self.begun).values().filter(|flag| !flag.load(Ordering::Acquire)).count()
    }

    /// Compiles one pipeline, `part` of [`part_count`], for [`Self::keep`]; one that is stored is returned as it is.
    pub(super) fn make(&self, variant: &PipelineVariant, part: usize) -> wgpu::ComputePipeline {
        locked(&self.begun).remove(&(variant.clone(), part));
        if let Some((pass, mode)) = parts(variant).nth(part)
            && let Some(stored) = self.compiled(pass, mode, variant)
        {
            return stored;
        }
        let mut made = None;
        if let Some(compile) = self.gpu.async_compile {
            (compile.take)(&self.gpu.device, &mut || made = Some(self.ask(variant, part)));
        }
        let (label, pipeline) = made.unwrap_or_else(|| self.ask(variant, part));
        locked(&self.made).push(label);
        pipeline
    }

    /// Creates one pipeline on the device, `part` of [`part_count`]; returns its label too.
    fn ask(&self, variant: &PipelineVariant, part: usize) -> (String, wgpu::ComputePipeline) {
        let found = parts(variant).nth(part);
        // Every caller takes `part` below `part_count`.
        let (pass, mode) = found.expect("a part of the set");
        self.compile(pass, mode, variant)
    }

    fn compile(
        &self,
        pass: &'static Pass,
        mode: usize,
        variant: &PipelineVariant,
    ) -> (String, wgpu::ComputePipeline) {
        let device = &self.gpu.device;
        // A general pipeline serves every mode.
        let own: &[_] = if variant.is_general() { &[] } else { pass.modes[mode] };
        let constants: Vec<_> = variant
            .kernel
            .map(|kernel| kernel.overrides())
            .unwrap_or_default()
            .into_iter()
            .chain(
                variant.constants.iter().chain(own).map(|(name, value)| (*name, f64::from(*value))),
            )
            .collect();
        let values = constants.iter().map(|(name, value)| format!(", {name} {value}"));
        let label = format!("{}{}", pass.name, values.collect::<String>());
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&label),
            layout: Some(&pipeline_layout(device, pass.name, &(pass.groups)(&self.layouts))),
            module: &self.shader(pass, variant),
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            cache: None,
        });
        (label, pipeline)
    }

    /// The pass's shader, parsed once for all variants with the same files.
    fn shader(&self, pass: &'static Pass, variant: &PipelineVariant) -> wgpu::ShaderModule {
        let module = shaders::module(pass.name, variant.kernel);
        let id = (pass.name, module.files.iter().map(|file| file.path).collect::<Vec<_>>());
        if let Some(shader) = locked(&self.shaders).get(&id) {
            return shader.clone();
        }
        let shader = module.create(&self.gpu.device);
        locked(&self.shaders).entry(id).or_insert(shader).clone()
    }

    /// Stores all pipelines of `variant`, in order; pipelines that are already stored stay.
    pub(super) fn keep(&self, variant: &PipelineVariant, made: Vec<wgpu::ComputePipeline>) {
        let mut compiled = locked(&self.compiled);
        for ((pass, mode), pipeline) in parts(variant).zip(made) {
            compiled.entry((pass.name, mode, variant.clone())).or_insert(pipeline);
        }
    }

    /// Marks `variant` as stored and used once.
    pub(super) fn set_ready(&self, variant: &PipelineVariant) {
        locked(&self.ready).insert(variant.clone());
    }

    /// The labels of all compiled pipelines, in order.
    pub fn made(&self) -> Vec<String> {
        locked(&self.made).clone()
    }
}

/// The pipelines of a variant: each pass of the set in each of its modes.
fn parts(variant: &PipelineVariant) -> impl Iterator<Item = (&'static Pass, usize)> + use<> {
    let set = variant.set;
    let is_general = variant.is_general();
    let passes = pass::all().filter(move |pass| pass.set == set);
    passes.flat_map(move |pass| {
        let modes = if is_general { 1 } else { pass.modes.len() };
        (0..modes).map(move |mode| (pass, mode))
    })
}

/// Number of pipelines of a variant.
pub fn part_count(variant: &PipelineVariant) -> usize {
    parts(variant).count()
}

/// The pipelines that draw one frame.
#[derive(Clone)]
pub struct FramePipelines<'a> {
    pipelines: &'a Pipelines,
    special: Vec<PipelineVariant>,
    formula: FormulaRef,
    replaced: HashMap<&'static str, wgpu::ComputePipeline>,
}

impl FramePipelines<'_> {
    /// Replaces the pipelines of `pass` by `pipeline`.
    pub fn replace(&mut self, pass: &Pass, pipeline: wgpu::ComputePipeline) {
        self.replaced.insert(pass.name, pipeline);
    }

    /// Draws with `variant` instead of the frame's own variant of the set, to rehearse it.
    pub fn draw_by(&mut self, variant: &PipelineVariant) {
        if let Some(special) = self.special.iter_mut().find(|special| special.set == variant.set) {
            *special = variant.clone();
        }
    }
}

impl PipelineSource for FramePipelines<'_> {
    fn pipeline(&self, pass: &'static Pass, mode: usize) -> wgpu::ComputePipeline {
        if let Some(replaced) = self.replaced.get(pass.name) {
            return replaced.clone();
        }
        match self.special.iter().find(|variant| variant.set == pass.set) {
            Some(variant) => self.pipelines.pipeline(pass, mode, variant),
            None => {
                let general = PipelineVariant::general_of(pass.set, self.formula);
                self.pipelines.pipeline(pass, mode, &general)
            }
        }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Each insertion is complete, so the collection is valid even if a thread panicked with the lock.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_with_special_variants_is_specialized_for_frames() {
        for pass in pass::all() {
            let is_listed = pipeline_set::SPECIALIZED.contains(&pass.set);
            assert_eq!(pass.set.is_specialized(), is_listed, "{}", pass.name);
        }
    }
}
