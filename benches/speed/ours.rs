//! The program's own side: stills as `mandelight render` draws them, and its passes one by one.

use std::{sync::Arc, time::Instant};

use mandelight::{
    gpu::readback::ReadbackError,
    render::{
        Kernels, Pace, Region, View,
        frame::{Dispatches, Recorder},
        kernels::Passes,
        pass,
        schedule::{Points, SAMPLE_WORKGROUPS, Stage, Trace},
        targets::Targets,
        uniforms::{Inputs, Picture},
    },
    scene::Scene,
};

use super::{Failure, counts::Counts};

/// Draws a still from nothing and says how long that took, milliseconds: from when the view has
/// its scene until its picture is there, tone mapped. Buffers are allocated before.
pub fn draw_ms(kernels: &Arc<Kernels>, scene: &Scene, size_px: [u32; 2]) -> (f64, View) {
    let mut view = View::new(kernels, Region::whole(size_px), Pace::Still);
    kernels.gpu.wait();
    let start = Instant::now();
    view.set_scene(scene, false);
    while view.pump(start.elapsed().as_secs_f64()) {
        view.wait();
    }
    kernels.gpu.wait();
    (start.elapsed().as_secs_f64() * 1e3, view)
}

/// The display picture's bytes, RGBA.
///
/// # Errors
/// Where the device is lost.
pub fn display(kernels: &Kernels, view: &View) -> Result<Vec<u8>, ReadbackError> {
    let texture = view.texture().ok_or(ReadbackError)?;
    let size_px = [texture.width(), texture.height()];
    mandelight::gpu::readback::Readback::texture(&kernels.gpu, texture, size_px).wait(&kernels.gpu)
}

type Record = fn(&mut Recorder<'_>, &Trace, &mandelight::render::lattice::Grid);

/// The passes over centre samples, in the order in which they run.
const PASSES: &[(&str, Record)] =
    &[MARCHING[0], MARCHING[1], MARCHING[2], ("shade", pass::shade::record)];

/// Those that evaluate the formula.
const MARCHING: &[(&str, Record)] = &[
    ("march", pass::march::record),
    ("normal", pass::normal::record),
    ("shadow", pass::shadow::record),
];

/// The program's passes over the centre samples of a whole picture, one submit each.
pub struct Split<'a> {
    kernels: &'a Kernels,
    inputs: Inputs,
    targets: Targets,
}

impl<'a> Split<'a> {
    /// Allocates the buffers. The power's own pipelines are there already.
    pub fn new(kernels: &'a Kernels, scene: &Scene, size_px: [u32; 2]) -> Self {
        let region = Region::whole(size_px);
        let inputs = Inputs::new(scene, region);
        let targets = Targets::new(kernels, region);
        targets.upload(&kernels.gpu.queue, &inputs);
        Self { kernels, inputs, targets }
    }

    /// What the passes know of the scene.
    pub fn picture(&self) -> &Picture {
        &self.inputs.picture
    }

    /// Each pass's name and time from submit to end, milliseconds.
    pub fn draw_ms(&self) -> Vec<(&'static str, f64)> {
        let passes = self.kernels.passes(&self.inputs.picture);
        let timed = |&(name, record): &(&'static str, Record)| {
            let commands = self.recorded(record, &passes, self.trace(Points::Level(0)));
            let start = Instant::now();
            self.kernels.gpu.queue.submit([commands]);
            self.kernels.gpu.wait();
            (name, start.elapsed().as_secs_f64() * 1e3)
        };
        PASSES.iter().map(timed).collect()
    }

    /// What each pass that marches takes for the centre samples, by pipelines that count into the
    /// film's first half.
    ///
    /// # Errors
    /// Where the device is lost.
    pub fn count(&self, passes: &Passes) -> Result<Vec<(&'static str, Counts)>, Failure> {
        let counted = |&(name, record): &(&'static str, Record)| {
            self.clear_counts();
            let commands = self.recorded(record, passes, self.trace(Points::Level(0)));
            self.kernels.gpu.queue.submit([commands]);
            Ok((name, self.counts()?))
        };
        MARCHING.iter().map(counted).collect()
    }

    /// What a later sample of every pixel takes; [`Self::count`] has marched the centre samples.
    ///
    /// # Errors
    /// Where the device is lost.
    pub fn count_later(&self, passes: &Passes) -> Result<Counts, Failure> {
        self.clear_counts();
        let all = self.trace(Points::Sample(1));
        // The jittered samples' buffers hold so many.
        for first in (0..all.workgroups).step_by(SAMPLE_WORKGROUPS as usize) {
            let workgroups = SAMPLE_WORKGROUPS.min(all.workgroups - first);
            let trace = Trace { first_workgroup: first, workgroups, ..all };
            for (_, record) in MARCHING {
                self.kernels.gpu.queue.submit([self.recorded(*record, passes, trace)]);
            }
        }
        Ok(self.counts()?)
    }

    fn clear_counts(&self) {
        let mut encoder = self.kernels.gpu.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(&self.targets.film_rg, 0, None);
        self.kernels.gpu.queue.submit([encoder.finish()]);
    }

    fn counts(&self) -> Result<Counts, ReadbackError> {
        Counts::read(&self.kernels.gpu, &self.targets.film_rg)
    }

    /// These points of the whole picture.
    fn trace(&self, points: Points) -> Trace {
        Trace {
            points,
            from: Stage::March,
            lights: u64::MAX >> (64 - self.inputs.picture.surface.light_count.clamp(1, 64)),
            first_workgroup: 0,
            workgroups: points.grid(self.inputs.picture.size_px).workgroups(),
        }
    }

    /// One pass over some points.
    fn recorded(&self, record: Record, passes: &Passes, trace: Trace) -> wgpu::CommandBuffer {
        let grid = trace.points.grid(self.inputs.picture.size_px);
        let mut dispatches = Dispatches::default();
        let mut recorder =
            Recorder::new(self.kernels, passes, &self.targets, &self.inputs, &mut dispatches);
        record(&mut recorder, &trace, &grid);
        recorder.finish()
    }
}
