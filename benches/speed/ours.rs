//! The program's side: stills as `mandelight render` draws them, and single passes.
//!
//! In: pipelines, a scene and a size. Out: times, pictures and counts.

use std::{sync::Arc, time::Instant};

use mandelight::{
    formula::Kernel,
    gpu::readback::ReadbackError,
    render::{
        Pace, Pipelines, Region, View,
        lattice::MAX_SAMPLES_TOGETHER,
        pass::{self, Pass},
        pipelines::FramePipelines,
        recorder::{Dispatches, Recorder},
        schedule::{BATCH_WORKGROUPS, Points, Stage, Trace},
        shaders,
        targets::Targets,
        uniforms::{FrameUniforms, Inputs},
    },
    scene::Scene,
};

use super::{
    counts::{self, Counts},
    failure::Failure,
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
    counts_layout: wgpu::BindGroupLayout,
    counts_group: wgpu::BindGroup,
}

impl<'a> PassRunner<'a> {
    /// Group and binding of the counters, which no pass of the program uses.
    pub const COUNTS: [u32; 2] = [3, 0];

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
        let inputs = Inputs::new(scene, region);
        let targets = Targets::new(&pipelines.layouts, region);
        targets.upload(&pipelines.gpu.queue, &inputs);
        let device = &pipelines.gpu.device;
        let counts = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("counts"),
            size: 8,
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let counts_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("counts"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: Self::COUNTS[1],
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: false },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let counts_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("counts"),
            layout: &counts_layout,
            entries: &[wgpu::BindGroupEntry {
                binding: Self::COUNTS[1],
                resource: counts.as_entire_binding(),
            }],
        });
        Self { pipelines, inputs, targets, workgroup_stride, counts, counts_layout, counts_group }
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

    /// A pipeline layout of counting passes, from the layout of the program's passes.
    pub fn counting_layout(&self, work_queues: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
        let layouts = &self.pipelines.layouts;
        self.pipelines.gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("counting passes"),
            bind_group_layouts: &[
                Some(&layouts.frame),
                Some(&layouts.gbuffer),
                Some(work_queues),
                Some(&self.counts_layout),
            ],
            immediate_size: 0,
        })
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

    /// Runs one pass and reads its counts.
    fn counted(
        &self,
        record: Record,
        passes: &FramePipelines<'_>,
        trace: Trace,
    ) -> Result<Counts, ReadbackError> {
        let queue = &self.pipelines.gpu.queue;
        queue.write_buffer(&self.counts, 0, &[0; 8]);
        queue.submit([self.recorded(record, passes, trace)]);
        Counts::read(&self.pipelines.gpu, &self.counts)
    }

    /// The work on `points` of the whole picture, in batches.
    fn traces(&self, points: Points) -> impl Iterator<Item = Trace> {
        let lights = u64::MAX >> (64 - self.inputs.frame.surface.light_count.clamp(1, 64));
        let all =
            points.grid(self.inputs.frame.size_px).workgroups().div_ceil(self.workgroup_stride);
        (0..all).step_by(BATCH_WORKGROUPS as usize).map(move |first_workgroup| Trace {
            points,
            from: Stage::March,
            lights,
            first_workgroup,
            workgroups: BATCH_WORKGROUPS.min(all - first_workgroup),
        })
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
        recorder.bind(Self::COUNTS[0], &self.counts_group);
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
    let [enqueue, queued] = [&pipelines.layouts.enqueue, &pipelines.layouts.dequeue]
        .map(|layout| runner.counting_layout(layout));
    let create =
        |layout: &wgpu::PipelineLayout, pass: &Pass, estimate: &str| -> Result<_, Failure> {
            let shader = counts::counting(
                gpu,
                &shaders::module(pass.name, Some(kernel)),
                &counts::marks(orbits_in, &[estimate], PassRunner::COUNTS),
            )?;
            Ok(gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(pass.name),
                layout: Some(layout),
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
    for (pass, layout, estimate) in [
        (&pass::camera_cone::PASS, &enqueue, estimate),
        (&pass::march::PASS, &queued, estimate),
        (&pass::normal::PASS, &queued, "distance_gradient"),
        (&pass::shadow_cone::PASS, &enqueue, estimate),
        (&pass::shadow::PASS, &queued, estimate),
    ] {
        passes.replace(pass, create(layout, pass, estimate)?);
    }
    Ok(passes)
}
