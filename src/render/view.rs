//! One picture in progress: its buffers, its schedule, and the scene that it shows.

use std::sync::Arc;

use super::{
    frame::{self, Dispatches, Recorder},
    kernels::Kernels,
    region::Region,
    report::{Activity, Report},
    schedule::{Pace, Schedule, Stale, Work},
    targets::Targets,
    uniforms::Inputs,
};
use crate::{
    gpu::{
        readback::{Readback, ReadbackError},
        timing::Stopwatch,
    },
    scene::{Quality, Scene},
};

/// A power that has been kept for so long, seconds, gets pipelines of its own.
const REST_SECS: f64 = 0.3;

/// One picture in progress.
pub struct View {
    kernels: Arc<Kernels>,
    region: Region,
    pace: Pace,
    targets: Targets,
    schedule: Schedule,
    stopwatch: Stopwatch<Work>,
    scene: Option<Scene>,
    inputs: Option<Inputs>,
    pending: Option<Scene>,
    moving: bool,
    /// It was said that pipelines will be compiled: the next pump does so, for the word to be
    /// seen first.
    compile_announced: bool,
    dispatches: Dispatches,
    /// The texture of the newest picture; while a new region has none, that of the old one.
    shown: Option<wgpu::Texture>,
    texture_generation: u64,
    now_secs: f64,
    changed_secs: f64,
    finished_secs: f64,
    busy_ms: f64,
    frame_ms: f64,
    pictures: u64,
}

impl View {
    /// Allocates the buffers of `region`, which is cut down where it does not
    /// [fit](Region::fits). Nothing is drawn before it has a scene.
    pub fn new(kernels: &Arc<Kernels>, region: Region, pace: Pace) -> Self {
        let region = drawable(region);
        Self {
            kernels: kernels.clone(),
            region,
            pace,
            targets: Targets::new(kernels, region.size_px),
            schedule: Schedule::new(pace, region.size_px),
            stopwatch: Stopwatch::default(),
            scene: None,
            inputs: None,
            pending: None,
            moving: false,
            compile_announced: false,
            dispatches: Dispatches::default(),
            shown: None,
            texture_generation: 0,
            now_secs: 0.0,
            changed_secs: 0.0,
            finished_secs: 0.0,
            busy_ms: 0.0,
            frame_ms: 0.0,
            pictures: 0,
        }
    }

    /// The rectangle that is drawn.
    pub fn region(&self) -> Region {
        self.region
    }

    /// Gives the view another rectangle; buffers are made again where its size differs.
    pub fn set_region(&mut self, region: Region) {
        let region = drawable(region);
        if region == self.region {
            return;
        }
        if region.size_px != self.region.size_px {
            self.targets = Targets::new(&self.kernels, region.size_px);
        }
        self.region = region;
        self.schedule.resize(region.size_px);
        if let Some(scene) = &self.scene {
            self.upload(Inputs::new(scene, region));
        }
    }

    /// Gives the view its scene. Only what changed becomes stale. `moving` says that more
    /// changes are expected at once (a drag, a flight): the view then stays on a sparse lattice.
    pub fn set_scene(&mut self, scene: &Scene, moving: bool) {
        self.moving = moving;
        self.schedule.set_moving(moving);
        self.pending = (self.scene.as_ref() != Some(scene)).then(|| scene.clone());
    }

    /// Submits as much work as fits now, without waiting. Call it once per displayed frame, or,
    /// for a still, in a loop with a device poll. `now_secs` is any steady clock. Returns true
    /// while there is more to do.
    pub fn pump(&mut self, now_secs: f64) -> bool {
        self.now_secs = now_secs;
        self.collect();
        if self.schedule.accepts_changes()
            && let Some(scene) = self.pending.take()
        {
            self.apply(scene);
        }
        if self.inputs.is_none() {
            return false;
        }
        if !self.prepare() {
            while let Some(work) = self.schedule.next(now_secs) {
                self.submit(work);
            }
        }
        let idle = self.schedule.status(now_secs).idle
            && self.pending.is_none()
            && !self.compile_announced;
        if !idle {
            self.finished_secs = now_secs;
        }
        !idle
    }

    /// Takes note of what the GPU has finished.
    fn collect(&mut self) {
        self.kernels.gpu.poll();
        while let Some(finished) = self.stopwatch.next_finished() {
            self.schedule.finished(finished.mark, finished.busy_ms);
            self.busy_ms += finished.busy_ms;
            if matches!(finished.mark, Work::Show { .. }) {
                self.frame_ms = std::mem::take(&mut self.busy_ms);
                self.pictures += 1;
            }
        }
    }

    /// Uploads a new scene and tells the schedule what it made stale.
    fn apply(&mut self, scene: Scene) {
        let inputs = Inputs::new(&scene, self.region);
        let stale = match &self.inputs {
            None => Some(Stale::Geometry),
            Some(old) => inputs.stale_since(old),
        };
        self.upload(inputs);
        let Quality { motion_budget_ms, samples, .. } = scene.quality;
        self.schedule.aim(motion_budget_ms, samples);
        if let Some(stale) = stale {
            self.schedule.change(stale, self.moving, self.now_secs);
            self.changed_secs = self.now_secs;
        }
        self.scene = Some(scene);
    }

    fn upload(&mut self, inputs: Inputs) {
        self.targets.upload(&self.kernels.gpu.queue, &inputs);
        self.inputs = Some(inputs);
    }

    fn integer_power(&self) -> u32 {
        self.inputs.as_ref().map_or(0, |inputs| inputs.picture.fractal.integer_power)
    }

    /// Sees to it that the power's own pipelines get compiled: for a still at once, otherwise
    /// when a picture has been shown and nothing has changed for a while. True while nothing else
    /// should start.
    fn prepare(&mut self) -> bool {
        let power = self.integer_power();
        if self.kernels.is_specialised(power) {
            self.compile_announced = false;
            return false;
        }
        if self.pace == Pace::Still || self.compile_announced {
            self.kernels.specialise(power);
            self.compile_announced = false;
            return false;
        }
        // Rest first: a drag of the power passes through many.
        self.compile_announced = self.schedule.status(self.now_secs).shown
            && !self.moving
            && self.now_secs - self.changed_secs >= REST_SECS;
        self.compile_announced
    }

    fn submit(&mut self, work: Work) {
        let Some(inputs) = &self.inputs else { return };
        let marchers = self.kernels.marchers(inputs.picture.fractal.integer_power);
        let mut recorder =
            Recorder::new(&self.kernels, &marchers, &self.targets, inputs, &mut self.dispatches);
        frame::record(&mut recorder, work);
        let commands = recorder.finish();
        self.stopwatch.submit(&self.kernels.gpu, commands, work);
        if matches!(work, Work::Show { .. }) && self.shown.as_ref() != Some(&self.targets.texture) {
            self.shown = Some(self.targets.texture.clone());
            self.texture_generation += 1;
        }
    }

    /// What the view is doing.
    pub fn report(&self) -> Report {
        let status = self.schedule.status(self.now_secs);
        let activity = if self.compile_announced {
            Activity::Compiling(format!("power {}", self.integer_power()))
        } else if self.inputs.is_none() || (status.idle && self.pending.is_none()) {
            Activity::Idle
        } else if status.moving {
            Activity::Moving
        } else {
            Activity::Refining
        };
        Report {
            activity,
            size_px: self.region.size_px,
            samples_done: status.samples_done,
            samples_wanted: self.scene.as_ref().map_or(1, |scene| scene.quality.samples),
            pixels_per_sample: 1 << status.shown_level,
            elapsed_secs: (self.finished_secs - self.changed_secs).max(0.0),
            frame_ms: self.frame_ms,
            pictures: self.pictures,
        }
    }

    /// How many dispatches of each pass there have been.
    pub fn dispatches(&self) -> Dispatches {
        self.dispatches
    }

    /// The newest picture: `Rgba8Unorm`, sRGB-encoded, opaque; usages TEXTURE_BINDING and
    /// COPY_SRC. It is always complete, never a half-filled lattice; none before the first.
    /// After a change of size it is the old one, in its own size, until there is a new one.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.shown.as_ref()
    }

    /// Changes whenever [`Self::texture`] is another texture than before.
    pub fn texture_generation(&self) -> u64 {
        self.texture_generation
    }

    /// Reads the centre samples' G-buffer back, waiting for it: for tests and tools, natively.
    pub fn gbuffer(&self) -> Result<super::gbuffer::Samples, ReadbackError> {
        let gpu = &self.kernels.gpu;
        let center = &self.targets.center;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu);
        Ok(super::gbuffer::Samples::decode(
            &read(&center.depth)?,
            &read(&center.normal)?,
            &read(&center.visibility)?,
        ))
    }
}

/// `region`, or as much of its picture as a view can draw.
fn drawable(region: Region) -> Region {
    if region.fits() { region } else { Region::whole_within_limits(region.picture_px) }
}
