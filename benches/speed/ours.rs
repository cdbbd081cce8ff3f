//! The program's side: stills as `mandelight render` draws them, and single passes.
//!
//! In: pipelines, a scene and a size. Out: times, pictures and counts.

use std::{sync::Arc, time::Instant};

use mandelight::{
    formula::Kernel,
    gpu::readback::ReadbackError,
    render::{
        Pace, Pipelines, Region, View,
        lattice::{MAX_SAMPLES_TOGETHER, WORKGROUP_BLOCKS},
        pass::{self, Pass},
        pipelines::FramePipelines,
        recorder::{Dispatches, Recorder},
        schedule::{Points, Stage, Trace},
        shaders,
        sky::SampledSky,
        space::RenderSpace,
        targets::Targets,
        uniforms::{FrameUniforms, Inputs},
        work_queues::WorkQueues,
    },
    scene::{RigKind, Scene},
};

use super::{
    counts::{self, Counts},
    failure::Failure,
    instrument::Counters,
};

/// Draws a still; milliseconds from setting the scene to the tone-mapped picture.
///
/// The time excludes the allocation of buffers.
pub fn draw_ms(pipelines: &Arc<Pipelines>, scene: &Scene, size_px: [u32; 2]) -> (f64, View) {
    let mut view = View::new(pipelines, Region::whole(size_px), Pace::Still);
    pipelines.gpu.wait();
    let start = Instant::now();
    view.set_scene(scene, false);
    while view.pump(start.elapsed().as_secs_f64()) {
        view.wait();
    }
    pipelines.gpu.wait();
    (start.elapsed().as_secs_f64() * 1e3, view)
}

/// Reads back the display picture, RGBA.
///
/// # Errors
/// If the device is lost.
pub fn display(pipelines: &Pipelines, view: &View) -> Result<Vec<u8>, ReadbackError> {
    let texture = view.texture().ok_or(ReadbackError)?;
    let size_px = [texture.width(), texture.height()];
    mandelight::gpu::readback::Readback::texture(&pipelines.gpu, texture, size_px)
        .wait(&pipelines.gpu)
}

type Record = fn(&mut Recorder<'_>, &Trace, &mandelight::render::lattice::Grid);

/// The passes over first samples, in the order in which they run.
const PASSES: [(&str, Record); 4] =
    [COUNTED_PASSES[0], COUNTED_PASSES[1], COUNTED_PASSES[2], ("shade", pass::shade::record)];

/// The passes that evaluate the formula, each after the passes that fill its work queue.
const COUNTED_PASSES: [(&str, Record); 3] = [
    ("march", |recorder, trace, grid| {
        pass::camera_rays::record(recorder, trace, grid);
        pass::camera_cone::record(recorder, trace, grid);
        pass::march::record(recorder, trace, grid);
        pass::compact_hits::record(recorder, trace, grid);
    }),
    ("normal", pass::normal::record),
    ("shadow", pass::shadow::record),
];

/// Runs the program's passes over a picture's samples, one submit per pass.
pub struct PassRunner<'a> {
    pipelines: &'a Pipelines,
    inputs: Inputs,
    targets: Targets,
    /// One of this many workgroups is drawn.
    workgroup_stride: u32,
    counts: wgpu::Buffer,
}

impl<'a> PassRunner<'a> {
    /// The counters of counting passes: those of queues that few bounces leave unused.
    ///
    /// A buffer of their own would exceed the device's number of storage buffers.
    const COUNTERS: Counters<'static> =
        Counters::Words(["work_queues.rays[RAY_QUEUES - 2u]", "work_queues.rays[RAY_QUEUES - 1u]"]);

    /// Allocates the buffers of a whole picture; expects specialised pipelines.
    pub fn new(pipelines: &'a Pipelines, scene: &Scene, size_px: [u32; 2]) -> Self {
        Self::with_stride(pipelines, scene, Region::whole(size_px), 1)
    }

    /// Allocates the buffers of a region of which one of `workgroup_stride` workgroups is drawn.
    ///
    /// Workgroups run in a scattered order, so the first ones sample the whole region.
    pub fn with_stride(
        pipelines: &'a Pipelines,
        scene: &Scene,
        region: Region,
        workgroup_stride: u32,
    ) -> Self {
        let space = RenderSpace::of(scene, region);
        let sky = (scene.lights.rig.kind == RigKind::Sky)
            .then(|| Arc::new(SampledSky::of_gradient(&scene.lights.rig.sky)));
        let inputs = Inputs::about(scene, region, &space).with_sky(scene, &space, sky.as_ref());
        let mut targets = Targets::new(&pipelines.layouts, region);
        let traces_paths = inputs.traces_paths();
        targets.fit_paths(&pipelines.layouts, traces_paths, sky.as_ref().filter(|_| traces_paths));
        targets.upload(&pipelines.gpu.queue, &inputs);
        let device = &pipelines.gpu.device;
        let counts = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("counts"),
            size: 8,
            usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { pipelines, inputs, targets, workgroup_stride, counts }
    }

    /// The frame's uniforms.
    pub fn frame(&self) -> &FrameUniforms {
        &self.inputs.frame
    }

    /// About how many pixels are drawn; workgroups at the region's border count as whole.
    pub fn pixels(&self) -> f64 {
        let grid = Points::Level(0).grid(self.inputs.frame.size_px);
        let pixels: f64 = self.inputs.frame.size_px.into_iter().map(f64::from).product();
        let workgroups = f64::from(grid.workgroups());
        pixels * f64::from(grid.workgroups().div_ceil(self.workgroup_stride)) / workgroups
    }

    /// The kernel that draws the picture.
    pub fn kernel(&self) -> Kernel {
        self.inputs.formula.kernel
    }

    /// The picture's inputs.
    pub fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    /// Name and time of each pass, milliseconds.
    pub fn draw_ms(&self) -> Vec<(&'static str, f64)> {
        let passes = self.pipelines.of_frame(&self.inputs);
        let mut ms = PASSES.map(|(name, _)| (name, 0.0));
        // Buffers hold the rays of one batch.
        for trace in self.traces(Points::Level(0)) {
            for ((_, ms), (_, record)) in ms.iter_mut().zip(PASSES) {
                let commands = self.recorded(record, &passes, trace);
                let start = Instant::now();
                self.pipelines.gpu.queue.submit([commands]);
                self.pipelines.gpu.wait();
                *ms += start.elapsed().as_secs_f64() * 1e3;
            }
        }
        ms.to_vec()
    }

    /// Counts of each pass over the first samples, by counting pipelines.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn count(
        &self,
        passes: &FramePipelines<'_>,
    ) -> Result<Vec<(&'static str, Counts)>, Failure> {
        let mut counts = COUNTED_PASSES.map(|(name, _)| (name, Counts::default()));
        for trace in self.traces(Points::Level(0)) {
            for ((_, counts), (_, record)) in counts.iter_mut().zip(COUNTED_PASSES) {
                *counts += self.counted(record, passes, trace)?;
            }
        }
        Ok(counts.to_vec())
    }

    /// Mean counts of the later samples of all pixels; call [`Self::count`] first.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn count_later(&self, passes: &FramePipelines<'_>) -> Result<Counts, Failure> {
        let mut counts = Counts::default();
        let points = Points::Samples { first: 1, count: MAX_SAMPLES_TOGETHER };
        for trace in self.traces(points) {
            for (_, record) in COUNTED_PASSES {
                counts += self.counted(record, passes, trace)?;
            }
        }
        Ok(counts.per(f64::from(MAX_SAMPLES_TOGETHER)))
    }

    /// Mean counts of a light path of each pixel, over the first ones.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn count_paths(&self, passes: &FramePipelines<'_>) -> Result<Counts, Failure> {
        let mut counts = Counts::default();
        let points = Points::Samples { first: 1, count: MAX_SAMPLES_TOGETHER };
        for trace in self.traces(points) {
            let trace = Trace { from: Stage::Path, lights: 0, ..trace };
            let follow: Record = pass::scatter::record;
            for record in [COUNTED_PASSES[0].1, COUNTED_PASSES[1].1, follow] {
                counts += self.counted(record, passes, trace)?;
            }
        }
        Ok(counts.per(f64::from(MAX_SAMPLES_TOGETHER)))
    }

    /// Runs one pass and reads its counts.
    fn counted(
        &self,
        record: Record,
        passes: &FramePipelines<'_>,
        trace: Trace,
    ) -> Result<Counts, ReadbackError> {
        let gpu = &self.pipelines.gpu;
        let (queues, at) = (&self.targets.work_queues.blocks, WorkQueues::LAST_COUNTERS);
        gpu.queue.write_buffer(queues, at, &[0; 8]);
        let pass = self.recorded(record, passes, trace);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(queues, at, &self.counts, 0, 8);
        gpu.queue.submit([pass, encoder.finish()]);
        Counts::read(&self.pipelines.gpu, &self.counts)
    }

    /// The work on `points` of the whole picture, in batches.
    fn traces(&self, points: Points) -> impl Iterator<Item = Trace> {
        let lights = u64::MAX >> (64 - self.inputs.frame.surface.light_count.clamp(1, 64));
        let whole = Trace::whole(points, Stage::March, lights, self.inputs.frame.size_px);
        let blocks = whole.workgroups().div_ceil(self.workgroup_stride) * WORKGROUP_BLOCKS;
        Trace { blocks, ..whole }.batches(self.targets.batch_workgroups)
    }

    /// Records one pass over a piece of work.
    fn recorded(
        &self,
        record: Record,
        passes: &FramePipelines<'_>,
        trace: Trace,
    ) -> wgpu::CommandBuffer {
        let grid = trace.points.grid(self.inputs.frame.size_px);
        let mut dispatches = Dispatches::default();
        let mut recorder = Recorder::new(
            &self.pipelines.layouts,
            passes,
            &self.targets,
            &self.inputs,
            &mut dispatches,
        );
        record(&mut recorder, &trace, &grid);
        recorder.finish()
    }
}

/// The name of the later samples' counts.
pub const LATER: &str = "a later sample";

/// The program's counts of a whole picture: the first sample by pass, then a later sample.
///
/// # Errors
/// If the device is lost, or a kernel can't be counted.
pub fn counts(
    pipelines: &Pipelines,
    scene: &Scene,
    size_px: [u32; 2],
) -> Result<Vec<(&'static str, Counts)>, Failure> {
    let runner = PassRunner::new(pipelines, scene, size_px);
    let passes = counting_passes(pipelines, &runner)?;
    let mut counted = runner.count(&passes)?;
    if scene.quality.samples > 1 {
        counted.push((LATER, runner.count_later(&passes)?));
    }
    Ok(counted)
}

/// Counting copies of the passes that evaluate the formula, for one pipeline key.
///
/// # Errors
/// If a kernel can't be counted.
pub fn counting_passes<'a>(
    pipelines: &'a Pipelines,
    runner: &PassRunner<'_>,
) -> Result<FramePipelines<'a>, Failure> {
    let kernel = runner.kernel();
    let constants = kernel.overrides();
    // Formulas of texts share their orbits.
    let (orbits_in, estimate) = if kernel.files().types.path.starts_with("language/") {
        ("language/", "estimate")
    } else {
        ("mandelbulb/", "estimate_at")
    };
    let gpu = &pipelines.gpu;
    let create = |pass: &Pass, estimate: &str| -> Result<_, Failure> {
        let shader = counts::counting(
            gpu,
            &shaders::module(pass.name, Some(kernel)),
            &counts::marks(orbits_in, &[estimate], PassRunner::COUNTERS),
        )?;
        let groups: Vec<_> = (pass.groups)(&pipelines.layouts).into_iter().map(Some).collect();
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("counting pass"),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        Ok(gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(pass.name),
            layout: Some(&layout),
            module: &shader,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            cache: None,
        }))
    };
    let mut passes = pipelines.of_frame(&runner.inputs);
    for (pass, estimate) in [
        (&pass::camera_cone::PASS, estimate),
        (&pass::march::PASS, estimate),
        (&pass::normal::PASS, "distance_gradient"),
        (&pass::shadow_cone::PASS, estimate),
        (&pass::shadow::PASS, estimate),
    ] {
        passes.replace(pass, create(pass, estimate)?);
    }
    Ok(passes)
}
