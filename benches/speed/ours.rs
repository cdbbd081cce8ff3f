//! The program's own side: stills as `mandelight render` draws them, and its passes one by one.

use std::{sync::Arc, time::Instant};

use mandelight::{
    gpu::{readback::ReadbackError, shader::Module},
    render::{
        Pace, Pipelines, Region, View,
        frame::{Dispatches, Recorder},
        lattice::MOST_TOGETHER,
        pass,
        pipelines::{Passes, PipelineKey},
        schedule::{MOST_WORKGROUPS, Points, SAMPLE_WORKGROUPS, Stage, Trace},
        targets::Targets,
        uniforms::{FrameUniforms, Inputs},
    },
    scene::Scene,
};

use super::{
    counts::{self, Counts},
    failure::Failure,
};

/// Draws a still from nothing and says how long that took, milliseconds: from when the view has
/// its scene until its picture is there, tone mapped. Buffers are allocated before.
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

/// The display picture's bytes, RGBA.
///
/// # Errors
/// Where the device is lost.
pub fn display(pipelines: &Pipelines, view: &View) -> Result<Vec<u8>, ReadbackError> {
    let texture = view.texture().ok_or(ReadbackError)?;
    let size_px = [texture.width(), texture.height()];
    mandelight::gpu::readback::Readback::texture(&pipelines.gpu, texture, size_px)
        .wait(&pipelines.gpu)
}

type Record = fn(&mut Recorder<'_>, &Trace, &mandelight::render::lattice::Grid);

/// The passes over centre samples, in the order in which they run.
const PASSES: [(&str, Record); 4] =
    [MARCHING[0], MARCHING[1], MARCHING[2], ("shade", pass::shade::record)];

/// Those that evaluate the formula, each after what lists its threads.
const MARCHING: [(&str, Record); 3] = [
    ("march", |recorder, trace, grid| {
        pass::camera_cone::record(recorder, trace, grid);
        pass::march::record(recorder, trace, grid);
        pass::compact_hits::record(recorder, trace, grid);
    }),
    ("normal", pass::normal::record),
    ("shadow", pass::shadow::record),
];

/// The program's passes over the samples of a whole picture, each in submits of its own.
pub struct Split<'a> {
    pipelines: &'a Pipelines,
    inputs: Inputs,
    targets: Targets,
    /// One workgroup of the picture in so many is drawn.
    spread: u32,
    counts: wgpu::Buffer,
    counts_layout: wgpu::BindGroupLayout,
    counts_group: wgpu::BindGroup,
}

impl<'a> Split<'a> {
    /// The bind group that no marching pass uses: counting copies add to its storage buffer.
    pub const COUNTS: [u32; 2] = [3, 0];

    /// Allocates the buffers. The power's own pipelines are there already.
    pub fn new(pipelines: &'a Pipelines, scene: &Scene, size_px: [u32; 2]) -> Self {
        Self::spread(pipelines, scene, Region::whole(size_px), 1)
    }

    /// The same of one workgroup in `spread`: work goes through a region in a scattered order, so
    /// that its first part shows a bit of everything.
    pub fn spread(pipelines: &'a Pipelines, scene: &Scene, region: Region, spread: u32) -> Self {
        let inputs = Inputs::new(scene, region);
        let targets = Targets::new(pipelines, region);
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
        Self { pipelines, inputs, targets, spread, counts, counts_layout, counts_group }
    }

    /// What the passes know of the scene.
    pub fn frame(&self) -> &FrameUniforms {
        &self.inputs.frame
    }

    /// About how many pixels are drawn: those of workgroups that reach past the region count whole.
    pub fn pixels(&self) -> f64 {
        let grid = Points::Level(0).grid(self.inputs.frame.size_px);
        let pixels: f64 = self.inputs.frame.size_px.into_iter().map(f64::from).product();
        let workgroups = f64::from(grid.workgroups());
        pixels * f64::from(grid.workgroups().div_ceil(self.spread)) / workgroups
    }

    /// What counting copies bind that either `queued` or `enqueue` passes are of.
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

    /// Each pass's name and time from submit to end, milliseconds.
    pub fn draw_ms(&self) -> Vec<(&'static str, f64)> {
        let passes = self.pipelines.passes(&self.inputs.frame);
        let mut ms = PASSES.map(|(name, _)| (name, 0.0));
        // Lists hold what one piece of work has listed.
        for trace in self.traces(Points::Level(0), MOST_WORKGROUPS) {
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

    /// What each pass that marches takes for the centre samples, by pipelines that count.
    ///
    /// # Errors
    /// Where the device is lost.
    pub fn count(&self, passes: &Passes) -> Result<Vec<(&'static str, Counts)>, Failure> {
        let mut counts = MARCHING.map(|(name, _)| (name, Counts::default()));
        for trace in self.traces(Points::Level(0), MOST_WORKGROUPS) {
            for ((_, counts), (_, record)) in counts.iter_mut().zip(MARCHING) {
                *counts += self.counted(record, passes, trace)?;
            }
        }
        Ok(counts.to_vec())
    }

    /// What later samples of every pixel take, in the mean; [`Self::count`] has marched the centre samples.
    ///
    /// # Errors
    /// Where the device is lost.
    pub fn count_later(&self, passes: &Passes) -> Result<Counts, Failure> {
        let mut counts = Counts::default();
        let points = Points::Samples { first: 1, count: MOST_TOGETHER };
        for trace in self.traces(points, SAMPLE_WORKGROUPS) {
            for (_, record) in MARCHING {
                counts += self.counted(record, passes, trace)?;
            }
        }
        Ok(counts.per(f64::from(MOST_TOGETHER)))
    }

    /// What one pass counts.
    fn counted(
        &self,
        record: Record,
        passes: &Passes,
        trace: Trace,
    ) -> Result<Counts, ReadbackError> {
        let queue = &self.pipelines.gpu.queue;
        queue.write_buffer(&self.counts, 0, &[0; 8]);
        queue.submit([self.recorded(record, passes, trace)]);
        Counts::read(&self.pipelines.gpu, &self.counts)
    }

    /// These points of the whole picture, in pieces of `most` workgroups.
    fn traces(&self, points: Points, most: u32) -> impl Iterator<Item = Trace> {
        let lights = u64::MAX >> (64 - self.inputs.frame.surface.light_count.clamp(1, 64));
        let all = points.grid(self.inputs.frame.size_px).workgroups().div_ceil(self.spread);
        (0..all).step_by(most as usize).map(move |first_workgroup| Trace {
            points,
            from: Stage::March,
            lights,
            first_workgroup,
            workgroups: most.min(all - first_workgroup),
        })
    }

    /// One pass over some points.
    fn recorded(&self, record: Record, passes: &Passes, trace: Trace) -> wgpu::CommandBuffer {
        let grid = trace.points.grid(self.inputs.frame.size_px);
        let mut dispatches = Dispatches::default();
        let mut recorder =
            Recorder::new(self.pipelines, passes, &self.targets, &self.inputs, &mut dispatches);
        recorder.bind(Self::COUNTS[0], &self.counts_group);
        record(&mut recorder, &trace, &grid);
        recorder.finish()
    }
}

/// What later samples' counts are called.
pub const LATER: &str = "a later sample";

/// The program's counts for the first sample of each pixel of a whole picture, pass by pass, and
/// for a later one where there is one.
///
/// # Errors
/// Where the device is lost, or a kernel can't be counted.
pub fn counts(
    pipelines: &Pipelines,
    scene: &Scene,
    size_px: [u32; 2],
) -> Result<Vec<(&'static str, Counts)>, Failure> {
    let split = Split::new(pipelines, scene, size_px);
    let passes = counting_passes(pipelines, &split)?;
    let mut counted = split.count(&passes)?;
    if scene.quality.samples > 1 {
        counted.push((LATER, split.count_later(&passes)?));
    }
    Ok(counted)
}

/// Copies of the passes that march, for pictures of one form, that count.
///
/// # Errors
/// Where a kernel can't be counted.
pub fn counting_passes(pipelines: &Pipelines, split: &Split<'_>) -> Result<Passes, Failure> {
    let constants = PipelineKey::of(split.frame()).constants();
    let gpu = &pipelines.gpu;
    let [enqueue, queued] = [&pipelines.layouts.enqueue, &pipelines.layouts.dequeue]
        .map(|layout| split.counting_layout(layout));
    let made =
        |layout: &wgpu::PipelineLayout, module: &Module, estimate: &str| -> Result<_, Failure> {
            let shader = counts::counting(gpu, module, &counts::marks(&[estimate], Split::COUNTS))?;
            Ok(gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(module.label),
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
    Ok(Passes {
        camera_cone: made(&enqueue, &pass::camera_cone::MODULE, "estimate_at")?,
        march: made(&queued, &pass::march::MODULE, "estimate_at")?,
        normal: made(&queued, &pass::normal::MODULE, "distance_gradient")?,
        shadow_cone: made(&enqueue, &pass::shadow_cone::MODULE, "estimate_at")?,
        shadow: made(&queued, &pass::shadow::MODULE, "estimate_at")?,
        ..pipelines.passes(split.frame())
    })
}
