//! The life of a frame: its passes, in the order in which they run.

use super::{
    indirect::{self, IndirectSource},
    lattice::{Grid, WORKGROUP_SIDE, WORKGROUP_THREADS},
    pass,
    pipelines::{Passes, Pipelines},
    post::{Post, Tasks},
    schedule::{Points, Stage, Trace, Work},
    targets::{MOST_SLICES, SLICE_STRIDE_BYTES, Targets},
    uniforms::{Inputs, Slice},
    work_queues::{BLOCK_THREADS, Queue},
};

/// Records one piece of work.
pub fn record(recorder: &mut Recorder<'_>, work: Work) {
    match work {
        Work::Trace(trace) => {
            let grid = trace.points.grid(recorder.inputs.frame.size_px);
            if trace.from <= Stage::March {
                pass::camera_cone::record(recorder, &trace, &grid);
                pass::march::record(recorder, &trace, &grid);
            }
            if trace.from <= Stage::Normal || trace.lights & recorder.inputs.casting() != 0 {
                pass::compact_hits::record(recorder, &trace, &grid);
            }
            if trace.from <= Stage::Normal {
                pass::normal::record(recorder, &trace, &grid);
            }
            if trace.from <= Stage::Shadow {
                pass::shadow::record(recorder, &trace, &grid);
            }
            // Indirect light of centre samples waits until all of a level have their direct light.
            let has_indirect =
                recorder.inputs.has_indirect() && matches!(trace.points, Points::Samples { .. });
            if trace.from <= Stage::Shade && !has_indirect {
                pass::shade::record(recorder, &trace, &grid);
            }
            if trace.from == Stage::Indirect || has_indirect {
                pass::indirect::record(recorder, &trace, &grid);
            }
        }
        Work::Show { level, fill, .. } => {
            if let Some(level) = recorder.upsample_level {
                recorder.begin_spread();
                pass::tonemap_sparse::record(recorder, level);
                pass::upsample::record(recorder, level);
                return;
            }
            if fill {
                pass::fill::record(recorder, level);
            }
            let tasks = recorder.begin_whole();
            if tasks.mean {
                pass::mean::record(recorder);
            }
            if tasks.histogram {
                pass::histogram::record(recorder);
            }
            if let Some(adapt) = tasks.adapt {
                pass::expose::record(recorder, tasks.mean, adapt);
            }
            if tasks.bloom {
                pass::bloom::record(recorder);
            }
            pass::tone::record(recorder, level);
        }
    }
}

/// How many dispatches of each pass there have been.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dispatches {
    /// Camera rays.
    pub march: u64,
    /// Passes that write work queues: of rays, with the cones that decide about them, and of hits.
    pub queue: u64,
    /// Normals.
    pub normal: u64,
    /// Shadow rays.
    pub shadow: u64,
    /// Not dispatches: how many shadow rays those had, were every sample point lit from every side.
    pub shadow_rays: u64,
    /// Shading.
    pub shade: u64,
    /// Shading with indirect light.
    pub indirect: u64,
    /// Filling in.
    pub fill: u64,
    /// Means of the film, of all their mip levels together.
    pub mean: u64,
    /// Histograms of the film.
    pub histogram: u64,
    /// Blooms, of all their mip levels and blurs together.
    pub bloom: u64,
    /// Tone mapping.
    pub tone: u64,
}

impl Dispatches {
    /// All of them.
    pub fn total(&self) -> u64 {
        let Self {
            march,
            queue,
            normal,
            shadow,
            shadow_rays: _,
            shade,
            indirect,
            fill,
            mean,
            histogram,
            bloom,
            tone,
        } = *self;
        march + queue + normal + shadow + shade + indirect + fill + mean + histogram + bloom + tone
    }
}

/// Records the dispatches of one submit: they run in order, each sees what the last one wrote.
pub struct Recorder<'a> {
    /// The pipelines.
    pub pipelines: &'a Pipelines,
    /// The forms of the picture's passes that it uses.
    pub passes: &'a Passes,
    /// The buffers.
    pub targets: &'a Targets,
    /// What the buffers hold of the scene.
    pub inputs: &'a Inputs,
    /// What is known of the film as a whole: the targets' own unless a view puts another here.
    pub post: &'a Post,
    /// Where indirect light comes from: the targets' own unless a view puts another here.
    pub indirect_source: IndirectSource,
    /// What of it a display brings up to date.
    pub tasks: Tasks,
    /// A count of workgroups, zero, that all dispatches have: drivers then compile what they left
    /// for the first use of a pipeline. None where this is no rehearsal.
    pub rehearsal: Option<wgpu::Buffer>,
    /// A display is made of the samples of this lattice level alone, and leaves the film as it is.
    pub upsample_level: Option<u32>,
    /// Counted by each pass.
    pub dispatches: &'a mut Dispatches,
    compute: wgpu::ComputePass<'static>,
    encoder: wgpu::CommandEncoder,
    slices: u32,
}

impl<'a> Recorder<'a> {
    /// An empty submit.
    pub fn new(
        pipelines: &'a Pipelines,
        passes: &'a Passes,
        targets: &'a Targets,
        inputs: &'a Inputs,
        dispatches: &'a mut Dispatches,
    ) -> Self {
        let mut encoder = pipelines.gpu.device.create_command_encoder(&Default::default());
        let mut compute = encoder.begin_compute_pass(&Default::default()).forget_lifetime();
        compute.set_bind_group(1, &targets.center.group, &[]);
        compute.set_bind_group(2, &targets.film_group, &[]);
        Self {
            pipelines,
            passes,
            targets,
            inputs,
            post: &targets.post,
            indirect_source: targets.indirect_source(inputs.frame.indirect.source_px),
            tasks: Tasks::default(),
            rehearsal: None,
            upsample_level: None,
            dispatches,
            compute,
            encoder,
            slices: 0,
        }
    }

    /// Turns from passes over sample points to those that see the film as a whole, and says which
    /// of them there are to be.
    fn begin_whole(&mut self) -> Tasks {
        self.compute.set_bind_group(1, &self.post.group, &[]);
        self.tasks
    }

    /// Turns to passes that use the jittered samples' buffers as a place for other things.
    fn begin_spread(&mut self) {
        self.compute.set_bind_group(1, &self.targets.jittered.group, &[]);
    }

    /// Binds the film, for passes after those that use work queues.
    pub fn bind_film(&mut self) {
        self.compute.set_bind_group(2, &self.targets.film_group, &[]);
    }

    /// Binds something of one's own, for pipelines that are not the program's.
    pub fn bind(&mut self, index: u32, group: &wgpu::BindGroup) {
        self.compute.set_bind_group(index, group, &[]);
    }

    /// Binds the environment map.
    pub fn bind_environment(&mut self) {
        self.compute.set_bind_group(3, &self.targets.environment_texture.group, &[]);
    }

    /// Binds the samples that indirect light is gathered from and for.
    pub fn bind_indirect(&mut self, trace: &Trace) {
        let samples = match trace.points {
            Points::Samples { .. } => &self.targets.jittered,
            _ => &self.targets.center,
        };
        let groups = indirect::groups(self.pipelines, self.targets, samples, &self.indirect_source);
        for (index, group) in (1..).zip(&groups) {
            self.compute.set_bind_group(index, group, &[]);
        }
    }

    /// The uniform of a trace; also binds the G-buffer that its samples live in.
    pub fn slice(&mut self, trace: &Trace, grid: &Grid) -> Slice {
        let mut slice = grid.slice(trace.first_workgroup);
        slice.blocks = trace.workgroups * (WORKGROUP_THREADS / BLOCK_THREADS);
        if let Points::Samples { first, count } = trace.points {
            slice.jitter = super::lattice::jitter(first);
            slice.samples = count;
            slice.compact = 1;
            slice.accumulate = 1;
            self.compute.set_bind_group(1, &self.targets.jittered.group, &[]);
        }
        slice
    }

    /// Adds a dispatch over all of a grid, for a lattice of `spacing` pixels.
    pub fn dispatch_grid(&mut self, pipeline: &wgpu::ComputePipeline, grid: &Grid, spacing: u32) {
        // More workgroups than one dispatch may have go into several.
        const MOST: u32 = 65_535;
        let total = grid.workgroups();
        for first in (0..total).step_by(MOST as usize) {
            let slice = Slice { spacing, ..grid.slice(first) };
            self.dispatch(pipeline, slice, MOST.min(total - first));
        }
    }

    /// Adds a dispatch over all pixels of the region, row by row.
    pub fn dispatch_plane(&mut self, pipeline: &wgpu::ComputePipeline, slice: Slice) {
        let workgroups = self.inputs.frame.size_px.map(|side| side.div_ceil(WORKGROUP_SIDE));
        self.dispatch_groups(pipeline, slice, workgroups);
    }

    /// Adds a dispatch with a thread for each pixel of a trace.
    pub fn dispatch_pixels(&mut self, pipeline: &wgpu::ComputePipeline, slice: Slice) {
        let pixels = (slice.blocks * BLOCK_THREADS) >> slice.samples_shift;
        self.dispatch(pipeline, slice, pixels.div_ceil(WORKGROUP_THREADS));
    }

    /// Adds a dispatch over all blocks of a trace that queues some of them.
    pub fn dispatch_blocks(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        work_queues: &wgpu::BindGroup,
        slice: Slice,
    ) {
        self.compute.set_bind_group(2, work_queues, &[]);
        self.dispatch(pipeline, slice, slice.blocks.div_ceil(WORKGROUP_THREADS));
        self.dispatches.queue += 1;
    }

    /// Adds a dispatch over a queue, which may write another.
    pub fn dispatch_queue(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        work_queues: &wgpu::BindGroup,
        slice: Slice,
        queue: Queue,
    ) {
        self.compute.set_bind_group(2, work_queues, &[]);
        self.prepare(pipeline, slice);
        let (workgroups, offset) = match &self.rehearsal {
            Some(nothing) => (nothing, 0),
            None => self.targets.work_queues.workgroups(queue),
        };
        self.compute.dispatch_workgroups_indirect(workgroups, offset);
    }

    /// Adds a dispatch of `workgroups`.
    pub fn dispatch(&mut self, pipeline: &wgpu::ComputePipeline, slice: Slice, workgroups: u32) {
        self.dispatch_groups(pipeline, slice, [workgroups, 1]);
    }

    fn dispatch_groups(
        &mut self,
        pipeline: &wgpu::ComputePipeline,
        slice: Slice,
        [columns, rows]: [u32; 2],
    ) {
        self.prepare(pipeline, slice);
        if let Some(nothing) = &self.rehearsal {
            self.compute.dispatch_workgroups_indirect(nothing, 0);
            return;
        }
        self.compute.dispatch_workgroups(columns, rows, 1);
    }

    /// Sets what the next dispatch has of its own.
    fn prepare(&mut self, pipeline: &wgpu::ComputePipeline, slice: Slice) {
        debug_assert!(self.slices < MOST_SLICES, "one submit has room for {MOST_SLICES} slices");
        let offset = self.slices * SLICE_STRIDE_BYTES;
        // Writes take effect in order with submits: the last submit has its own slices already.
        self.pipelines.gpu.queue.write_buffer(
            &self.targets.slices,
            u64::from(offset),
            bytemuck::bytes_of(&slice),
        );
        self.slices += 1;
        self.compute.set_pipeline(pipeline);
        self.compute.set_bind_group(0, &self.targets.frame_group, &[offset]);
    }

    /// The commands, ready for submission.
    pub fn finish(self) -> wgpu::CommandBuffer {
        drop(self.compute);
        self.encoder.finish()
    }
}
