//! Pipelines on their way: announced, compiled asynchronously or one at a time, and used once before they
//! count.
//!
//! In: what a view lacks, the time. Out: the same pipelines, [kept](Kernels) and ready. A view
//! that someone watches says what it prepares before anything is compiled, so that the word is on
//! the screen should the screen stand still; it keeps its picture meanwhile. Drivers leave part of the work
//! for the first use of a pipeline, some all of it: a rehearsal of no workgroups has that done, and
//! the GPU's own word tells when.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::{
    frame::{self, Dispatches, Recorder},
    pipelines::{PipelineVariant, Pipelines},
    post::Tasks,
    schedule::{Points, Stage, Trace, Work},
    targets::Targets,
    uniforms::Inputs,
};

/// Displayed frames after which the word is on the screen: one to draw it, one more to know that
/// it was shown.
const FRAMES_TO_SEE: u32 = 2;

/// After this long nobody looks, seconds: a page that is hidden draws no frames.
const UNSEEN_SECS: f64 = 0.25;

/// Pipelines on their way.
pub struct Preparation {
    variant: PipelineVariant,
    announced_secs: f64,
    frames: u32,
    /// Whether each part has been compiled asynchronously; empty before that began, and where it cannot.
    compiled: Vec<Arc<AtomicBool>>,
    made: Vec<wgpu::ComputePipeline>,
    /// Whether the rehearsal is over; none before it.
    rehearsed: Option<Arc<AtomicBool>>,
}

/// How far a preparation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Other work can go on.
    Background,
    /// Other work should wait.
    Foreground,
    /// All are ready.
    Ready,
}

impl Preparation {
    /// Says what will be compiled.
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

    /// What is prepared.
    pub fn variant(&self) -> PipelineVariant {
        self.variant
    }

    /// Whether more than the word is out.
    pub fn has_begun(&self) -> bool {
        !self.made.is_empty() || !self.compiled.is_empty() || self.rehearsed.is_some()
    }

    /// The interface has drawn a frame.
    pub fn note_frame(&mut self) {
        self.frames += 1;
    }

    /// Does what comes next: of pipelines that hold others up, one at most.
    pub fn step(
        &mut self,
        pipelines: &Pipelines,
        targets: &Targets,
        inputs: &Inputs,
        now_secs: f64,
    ) -> Progress {
        let is_true = |flag: &Arc<AtomicBool>| flag.load(Ordering::Acquire);
        if let Some(rehearsed) = &self.rehearsed {
            if !is_true(rehearsed) {
                return Progress::Foreground;
            }
            pipelines.set_ready(self.variant);
            return Progress::Ready;
        }
        let is_seen = self.frames >= FRAMES_TO_SEE || now_secs - self.announced_secs >= UNSEEN_SECS;
        if !is_seen {
            return Progress::Background;
        }
        let parts = self.variant.parts();
        if !self.has_begun() {
            self.compiled =
                (0..parts).filter_map(|part| pipelines.begin(self.variant, part)).collect();
        }
        if !self.compiled.iter().all(is_true) {
            return Progress::Background;
        }
        let at_once = if self.compiled.is_empty() { 1 } else { parts };
        for part in (self.made.len()..parts).take(at_once) {
            self.made.push(pipelines.make(self.variant, part));
        }
        if self.made.len() == parts {
            pipelines.keep(self.variant, std::mem::take(&mut self.made));
            self.rehearsed = Some(rehearse(self.variant, pipelines, targets, inputs));
        }
        Progress::Foreground
    }
}

/// Submits every pass of `variant` once, without workgroups. The answer turns true when the GPU is
/// through with it.
fn rehearse(
    variant: PipelineVariant,
    pipelines: &Pipelines,
    targets: &Targets,
    inputs: &Inputs,
) -> Arc<AtomicBool> {
    let mut picture = inputs.frame;
    if let PipelineVariant::Rays(key) | PipelineVariant::Normals(key, _) = variant {
        key.put_into(&mut picture);
    }
    let passes = pipelines.passes(&picture);
    let mut uncounted = Dispatches::default();
    let mut recorder = Recorder::new(pipelines, &passes, targets, inputs, &mut uncounted);
    // A count in a buffer: browsers warn of a plain zero.
    recorder.rehearsal = Some(pipelines.gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("no workgroups"),
        size: 12,
        usage: wgpu::BufferUsages::INDIRECT,
        mapped_at_creation: false,
    }));
    if variant == PipelineVariant::Post {
        recorder.tasks = Tasks { mean: true, histogram: true, adapt: Some(1.0), bloom: true };
    }
    let trace = |points: Points, from: Stage| {
        Work::Trace(Trace { points, from, lights: 1, first_workgroup: 0, workgroups: 0 })
    };
    let show = |level: u32| Work::Show { level, fill: false, film: false, adapt: 1.0 };
    let work = match variant {
        PipelineVariant::Rays(_) | PipelineVariant::Normals(..) => {
            vec![trace(Points::Level(0), Stage::March)]
        }
        // Of single samples, and of some together.
        PipelineVariant::Shade(_) => [Points::Level(0), Points::Samples { first: 1, count: 2 }]
            .map(|points| trace(points, Stage::Shade))
            .to_vec(),
        PipelineVariant::Indirect => vec![trace(Points::Indirect(0), Stage::Indirect)],
        PipelineVariant::Post => vec![show(0)],
        // Of a whole picture, and of a sparse lattice.
        PipelineVariant::Tone(_) => vec![show(0), show(1)],
    };
    for work in work {
        frame::record(&mut recorder, work);
    }
    let queue = &pipelines.gpu.queue;
    queue.submit([recorder.finish()]);
    let is_over = Arc::new(AtomicBool::new(false));
    let tell = is_over.clone();
    queue.on_submitted_work_done(move || tell.store(true, Ordering::Release));
    is_over
}
