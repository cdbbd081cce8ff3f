//! Pipelines on their way: announced, compiled one at a time, and used once before they count.
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
    glow::Tasks,
    kernels::{Extra, Kernels},
    schedule::{Points, Stage, Trace, Work},
    targets::Targets,
    uniforms::Inputs,
};

/// How long the word is out before anything is compiled, seconds: three displayed frames.
const ANNOUNCE_SECS: f64 = 0.05;

/// Pipelines on their way.
pub struct Preparation {
    extra: Extra,
    announced_secs: f64,
    made: Vec<wgpu::ComputePipeline>,
    /// Whether the rehearsal is over; none before it.
    rehearsed: Option<Arc<AtomicBool>>,
}

impl Preparation {
    /// Says what will be compiled.
    pub fn announce(extra: Extra, now_secs: f64) -> Self {
        Self { extra, announced_secs: now_secs, made: Vec::new(), rehearsed: None }
    }

    /// What is prepared.
    pub fn extra(&self) -> Extra {
        self.extra
    }

    /// Whether more than the word is out.
    pub fn has_begun(&self) -> bool {
        !self.made.is_empty()
    }

    /// Does what comes next, one pipeline at most. True once all are ready.
    pub fn step(
        &mut self,
        kernels: &Kernels,
        targets: &Targets,
        inputs: &Inputs,
        now_secs: f64,
    ) -> bool {
        if let Some(rehearsed) = &self.rehearsed {
            let is_over = rehearsed.load(Ordering::Acquire);
            if is_over {
                kernels.set_ready(self.extra);
            }
            return is_over;
        }
        if now_secs - self.announced_secs < ANNOUNCE_SECS {
            return false;
        }
        self.made.push(kernels.make(self.extra, self.made.len()));
        if self.made.len() == self.extra.parts() {
            kernels.keep(self.extra, self.made.clone());
            self.rehearsed = Some(rehearse(self.extra, kernels, targets, inputs));
        }
        false
    }
}

/// Submits every pass of `extra` once, without workgroups. The answer turns true when the GPU is
/// through with it.
fn rehearse(
    extra: Extra,
    kernels: &Kernels,
    targets: &Targets,
    inputs: &Inputs,
) -> Arc<AtomicBool> {
    let power = if let Extra::Power(power) = extra { power } else { 0 };
    let marchers = kernels.marchers(power);
    let mut uncounted = Dispatches::default();
    let mut recorder = Recorder::new(kernels, &marchers, targets, inputs, &mut uncounted);
    recorder.is_rehearsal = true;
    recorder.tasks = Tasks { mean: true, histogram: true, adapt: Some(1.0), bloom: true };
    let trace = |points: Points, from: Stage| {
        Work::Trace(Trace { points, from, lights: 1, first_workgroup: 0, workgroups: 0 })
    };
    let work = match extra {
        Extra::Power(_) => trace(Points::Level(0), Stage::March),
        Extra::Gather => trace(Points::Around(0), Stage::Gather),
        Extra::Glow => Work::Show { level: 0, fill: false, adapt: 1.0 },
    };
    frame::record(&mut recorder, work);
    let queue = &kernels.gpu.queue;
    queue.submit([recorder.finish()]);
    let is_over = Arc::new(AtomicBool::new(false));
    let tell = is_over.clone();
    queue.on_submitted_work_done(move || tell.store(true, Ordering::Release));
    is_over
}
