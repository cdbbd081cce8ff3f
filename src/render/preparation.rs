//! Prepares pipelines: announces them, compiles them, and uses them once before they count as ready.
//!
//! In: the variants that a view lacks, the time. Out: the same variants, [stored](Pipelines) and ready. An
//! interactive view announces a variant before compiling it, so that the message is on the screen if
//! compilation freezes the page; the view keeps its picture meanwhile. Drivers leave part of the work, some
//! all of it, for the first use of a pipeline. A rehearsal without workgroups triggers that work, and the
//! GPU's completion callback reports its end.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::{
    frame,
    integrator::{DIRECT, PATH, PATH_IN_MEDIUM},
    pass::{self, assess_noise},
    pipeline_set,
    pipelines::{PipelineVariant, Pipelines, part_count},
    post::Tasks,
    recorder::{Dispatches, Recorder, Rehearsal},
    schedule::{Stage, Trace, Work},
    targets::Targets,
    uniforms::Inputs,
};

/// Frames after which the message is visible: one to draw it, one more to know it was shown.
const FRAMES_TO_SEE: u32 = 2;

/// Time after which nobody is watching, in seconds: a hidden page draws no frames.
const UNSEEN_SECS: f64 = 0.25;

/// The preparation of one variant.
pub struct Preparation {
    variant: PipelineVariant,
    announced_secs: f64,
    frames: u32,
    /// Flags of asynchronous compilations, one for each of the first parts; empty before their start, or if unsupported.
    compiled: Vec<Arc<AtomicBool>>,
    made: Vec<wgpu::ComputePipeline>,
    /// The flag that the rehearsal has finished; none before the rehearsal.
    rehearsed: Option<Arc<AtomicBool>>,
}

/// How far a preparation has come, and whether other work may run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PreparationState {
    /// Other work may run.
    Background,
    /// Other work must wait.
    Foreground,
    /// All pipelines are ready.
    Ready,
}

impl Preparation {
    /// Announces `variant`; compiles nothing yet.
    pub fn announce(variant: PipelineVariant, now_secs: f64) -> Self {
        Self {
            variant,
            announced_secs: now_secs,
            frames: 0,
            compiled: Vec::new(),
            made: Vec::new(),
            rehearsed: None,
        }
    }

    /// The variant in preparation.
    pub fn variant(&self) -> &PipelineVariant {
        &self.variant
    }

    /// Whether compilation has begun.
    pub fn has_begun(&self) -> bool {
        !self.made.is_empty() || !self.compiled.is_empty() || self.rehearsed.is_some()
    }

    /// Notes that the interface has drawn a frame.
    pub fn note_frame(&mut self) {
        self.frames += 1;
    }

    /// Takes the next step.
    ///
    /// With asynchronous compilation, no pipeline is begun while `at_once` are under way, for all views. Without, a step
    /// compiles one.
    pub fn step(
        &mut self,
        pipelines: &Pipelines,
        targets: &Targets,
        inputs: &Inputs,
        at_once: usize,
        now_secs: f64,
    ) -> PreparationState {
        let is_true = |flag: &Arc<AtomicBool>| flag.load(Ordering::Acquire);
        if let Some(rehearsed) = &self.rehearsed {
            if !is_true(rehearsed) {
                return PreparationState::Foreground;
            }
            pipelines.set_ready(&self.variant);
            return PreparationState::Ready;
        }
        let is_seen = self.frames >= FRAMES_TO_SEE || now_secs - self.announced_secs >= UNSEEN_SECS;
        if !is_seen {
            return PreparationState::Background;
        }
        let parts = part_count(&self.variant);
        let is_async = pipelines.gpu.async_compile.is_some();
        // Another view may have compiled them meanwhile.
        if is_async && !pipelines.has_own(&self.variant) {
            while self.compiled.len() < parts
                && pipelines.under_way() < at_once
                && let Some(flag) = pipelines.begin(&self.variant, self.compiled.len())
            {
                self.compiled.push(flag);
            }
            if self.compiled.len() < parts || !self.compiled.iter().all(is_true) {
                return PreparationState::Background;
            }
        }
        let now = if is_async { parts } else { 1 };
        for part in (self.made.len()..parts).take(now) {
            self.made.push(pipelines.make(&self.variant, part));
        }
        if self.made.len() == parts {
            pipelines.keep(&self.variant, std::mem::take(&mut self.made));
            self.rehearsed = Some(rehearse(&self.variant, pipelines, targets, inputs));
        }
        PreparationState::Foreground
    }
}

/// Submits every pass of `variant` once, without workgroups.
///
/// The flag turns true when the GPU has finished.
fn rehearse(
    variant: &PipelineVariant,
    pipelines: &Pipelines,
    targets: &Targets,
    inputs: &Inputs,
) -> Arc<AtomicBool> {
    let mut passes = pipelines.of_frame(inputs);
    passes.draw_by(variant);
    let mut rehearsed = Dispatches::default();
    let mut recorder = Recorder::new(&pipelines.layouts, &passes, targets, inputs, &mut rehearsed);
    // An indirect dispatch with a count of zero: browsers warn of a direct dispatch with zero.
    let no_workgroups = pipelines.gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("no workgroups"),
        size: 12,
        usage: wgpu::BufferUsages::INDIRECT,
        mapped_at_creation: false,
    });
    recorder.rehearsal = Some(Rehearsal { set: variant.set, no_workgroups });
    if *variant.set == pipeline_set::POST {
        recorder.tasks = Tasks { mean: true, histogram: true, adapt: Some(1.0), bloom: true };
    }
    recorder.denoises = *variant.set == pipeline_set::DENOISE;
    for work in variant.rehearsal() {
        let integrator = match work {
            _ if *variant.set == pipeline_set::MEDIUM => &PATH_IN_MEDIUM,
            Work::Trace(Trace { from: Stage::Path, .. }) => &PATH,
            _ => &DIRECT,
        };
        frame::record(integrator, &mut recorder, work);
    }
    if *variant.set == pipeline_set::FILM_PATHS {
        // Otherwise between samples.
        assess_noise::record(&mut recorder);
    }
    let queue = &pipelines.gpu.queue;
    queue.submit([recorder.finish()]);
    let mut of_set = pass::all().filter(|pass| pass.set == variant.set);
    debug_assert!(
        of_set.all(|pass| rehearsed.of(pass).dispatches > 0),
        "the rehearsal of {variant:?} has only {:?}",
        rehearsed.passes(),
    );
    let is_over = Arc::new(AtomicBool::new(false));
    let tell = is_over.clone();
    queue.on_submitted_work_done(move || tell.store(true, Ordering::Release));
    is_over
}
