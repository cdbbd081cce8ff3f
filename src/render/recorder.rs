//! Records the passes of one submit: bindings and dispatches.

use std::{collections::BTreeMap, ops::Range};

use super::{
    display_parts::PartRange,
    indirect::{self, IndirectSource},
    lattice::{self, BLOCK_THREADS, Grid, WORKGROUP_BLOCKS, WORKGROUP_SIDE, WORKGROUP_THREADS},
    layouts::Layouts,
    occupancy::Occupancy,
    pipeline_set::PipelineSet,
    post::{Post, Tasks},
    schedule::{Display, KeptPixels, Points, Stage, Trace},
    targets::{DISPATCH_PARAMS_STRIDE_BYTES, MAX_DISPATCHES, Targets},
    uniforms::{DispatchParams, Inputs},
    work_queues::Queue,
};
use crate::gpu::host_shared::HostShared;

/// Number of the first jittered sample: the centre sample comes before.
const FIRST_JITTERED: u32 = 1;

/// One pass: its shader, its bindings, and when a frame has the pass.
pub struct Pass {
    /// The stem of the pass's two files, `pass/<name>.rs` and `shaders/pass/<name>.wgsl`.
    pub name: &'static str,
    /// What the pass binds, group by group.
    pub groups: fn(&Layouts) -> Vec<&wgpu::BindGroupLayout>,
    /// The pipelines that are compiled together with the pass's.
    pub set: &'static PipelineSet,
    /// The modes of the pass: overrides of each of its pipelines, in addition to those of the set.
    pub modes: &'static [&'static [(&'static str, u32)]],
    /// When a frame has the pass, and how the pass is recorded.
    pub record: Record,
}

/// The modes of a pass with a single pipeline.
pub const ONE_MODE: &[&[(&str, u32)]] = &[&[]];

/// When a frame has a pass, and how the pass is recorded.
pub enum Record {
    /// The pass works on sample points.
    Trace {
        /// Whether a trace has the pass.
        when: fn(&Recorder<'_>, &Trace) -> bool,
        /// Records the pass.
        record: fn(&mut Recorder<'_>, &Trace, &Grid),
    },
    /// The pass makes a display of the film.
    Film {
        /// The parts of a display in which the pass is recorded.
        parts: PartRange,
        /// Whether a display has the pass.
        when: fn(&Recorder<'_>, &Display) -> bool,
        /// Records the pass.
        record: fn(&mut Recorder<'_>, &Display),
    },
    /// The pass makes a display of a sparse lattice's samples alone: the film between them is stale.
    Sparse {
        /// Records the pass for a lattice level.
        record: fn(&mut Recorder<'_>, u32),
    },
    /// Another pass records this one.
    Within,
}

/// Provides the pipelines of a recorder.
pub trait PipelineSource {
    /// The fastest compiled pipeline of `pass`, in one of the pass's modes.
    fn pipeline(&self, pass: &'static Pass, mode: usize) -> wgpu::ComputePipeline;
}

/// A pass with its pipeline, for dispatches.
pub struct PassPipeline {
    pass: &'static Pass,
    /// None for a pass that a rehearsal leaves out.
    pipeline: Option<wgpu::ComputePipeline>,
}

/// A first use of a set's pipelines, without work: drivers then compile what they leave for it.
pub struct Rehearsal {
    /// The set whose passes are recorded; other passes are left out.
    pub set: &'static PipelineSet,
    /// A workgroup count of zero for all dispatches.
    pub no_workgroups: wgpu::Buffer,
}

/// The recorded work of one pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Number of dispatches.
    pub dispatches: u64,
    /// Samples covered, summed over dispatches: an upper bound of the rays marched. 0 for film passes.
    pub samples: u64,
}

/// Counters of recorded work by pass, for tests and the page's status.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Dispatches {
    by_pass: BTreeMap<&'static str, Count>,
}

impl Dispatches {
    /// The recorded work of `pass`.
    pub fn of(&self, pass: &Pass) -> Count {
        self.by_pass.get(pass.name).copied().unwrap_or_default()
    }

    /// The names of all passes that were recorded, in alphabetical order.
    pub fn passes(&self) -> Vec<&'static str> {
        self.by_pass.keys().copied().collect()
    }

    /// Number of all dispatches.
    pub fn total(&self) -> u64 {
        self.by_pass.values().map(|count| count.dispatches).sum()
    }

    /// What has been recorded since the counters were `before`.
    pub fn since(&self, before: &Self) -> Self {
        let new = self.by_pass.iter().filter_map(|(name, count)| {
            let old = before.by_pass.get(name).copied().unwrap_or_default();
            let dispatches = count.dispatches - old.dispatches;
            let samples = count.samples - old.samples;
            (dispatches > 0).then_some((*name, Count { dispatches, samples }))
        });
        Self { by_pass: new.collect() }
    }

    fn add(&mut self, pass: &Pass, params: &DispatchParams) {
        let count = self.by_pass.entry(pass.name).or_default();
        count.dispatches += 1;
        count.samples += u64::from(params.blocks * BLOCK_THREADS);
    }
}

/// Records the dispatches of one submit, which run in order: each sees the results of the last.
pub struct Recorder<'a> {
    /// The device and the bind group layouts.
    pub layouts: &'a Layouts,
    /// The pipelines.
    pipelines: &'a dyn PipelineSource,
    /// The buffers.
    pub targets: &'a Targets,
    /// The scene's uniforms in the buffers.
    pub inputs: &'a Inputs,
    /// Film statistics: the targets' own, unless a view replaces them.
    pub post: &'a Post,
    /// The source of indirect light: the targets' own, unless a view replaces it.
    pub indirect_source: IndirectSource,
    /// The parts of a display that are recorded.
    pub parts: PartRange,
    /// The post passes that a display runs.
    pub tasks: Tasks,
    /// Whether a display shows denoised light.
    pub denoises: bool,
    /// The rehearsal that this submit is; none in other submits.
    pub rehearsal: Option<Rehearsal>,
    /// The lattice level from whose samples alone the display is made; the film stays as it is.
    pub upsample_level: Option<u32>,
    /// Counters of the recorded work.
    pub dispatches: &'a mut Dispatches,
    compute: wgpu::ComputePass<'static>,
    encoder: wgpu::CommandEncoder,
    recorded: u32,
}

impl<'a> Recorder<'a> {
    /// An empty submit.
    pub fn new(
        layouts: &'a Layouts,
        pipelines: &'a dyn PipelineSource,
        targets: &'a Targets,
        inputs: &'a Inputs,
        dispatches: &'a mut Dispatches,
    ) -> Self {
        Self::named("passes", layouts, pipelines, targets, inputs, dispatches)
    }

    /// An empty submit, which tools of the GPU call `label`.
    pub fn named(
        label: &str,
        layouts: &'a Layouts,
        pipelines: &'a dyn PipelineSource,
        targets: &'a Targets,
        inputs: &'a Inputs,
        dispatches: &'a mut Dispatches,
    ) -> Self {
        let named = wgpu::CommandEncoderDescriptor { label: Some(label) };
        let mut encoder = layouts.gpu.device.create_command_encoder(&named);
        let mut compute = encoder.begin_compute_pass(&Default::default()).forget_lifetime();
        compute.set_bind_group(1, &targets.center.group, &[]);
        compute.set_bind_group(2, &targets.film_group, &[]);
        Self {
            layouts,
            pipelines,
            targets,
            inputs,
            post: &targets.post,
            indirect_source: IndirectSource::of(targets, inputs.frame.indirect.source_px),
            parts: PartRange::ALL,
            tasks: Tasks::default(),
            denoises: false,
            rehearsal: None,
            upsample_level: None,
            dispatches,
            compute,
            encoder,
            recorded: 0,
        }
    }

    /// The fastest compiled pipeline of `pass`, in one of the pass's modes.
    pub fn pipeline(&self, pass: &'static Pass, mode: usize) -> PassPipeline {
        let is_recorded = self.rehearsal.as_ref().is_none_or(|rehearsal| rehearsal.set == pass.set);
        PassPipeline { pass, pipeline: is_recorded.then(|| self.pipelines.pipeline(pass, mode)) }
    }

    /// Binds the film statistics, for passes over the whole film.
    pub fn bind_post(&mut self) {
        self.compute.set_bind_group(1, &self.post.group, &[]);
    }

    /// Binds the film, for passes after those that use work queues.
    pub fn bind_film(&mut self) {
        self.compute.set_bind_group(2, &self.targets.film_group, &[]);
    }

    /// Binds the bins of colour values.
    pub fn bind_color_bins(&mut self) {
        self.compute.set_bind_group(2, &self.targets.color_bins_group, &[]);
    }

    /// Binds any group, for pipelines from outside this crate.
    pub fn bind(&mut self, index: u32, group: &wgpu::BindGroup) {
        self.compute.set_bind_group(index, group, &[]);
    }

    /// Binds the environment map.
    pub fn bind_environment(&mut self) {
        self.compute.set_bind_group(3, &self.targets.environment_texture.group, &[]);
    }

    /// Binds the light paths and their sky.
    pub fn bind_paths(&mut self) {
        self.compute.set_bind_group(3, &self.targets.paths.group, &[]);
    }

    /// Binds the noise of pixels for cones of camera rays.
    pub fn bind_moments(&mut self) {
        self.compute.set_bind_group(3, &self.targets.paths.moments_group, &[]);
    }

    /// Binds the light paths and the noise of pixels for the passes after paths.
    pub fn bind_traced_paths(&mut self) {
        self.compute.set_bind_group(1, &self.targets.paths.traced_group, &[]);
    }

    /// Binds the samples of the indirect source and of `trace`.
    pub fn bind_indirect(&mut self, trace: &Trace) {
        let samples = match trace.points {
            Points::Samples { .. } => &self.targets.jittered,
            _ => &self.targets.center,
        };
        let groups = indirect::groups(self.layouts, self.targets, samples, &self.indirect_source);
        for (index, group) in (1..).zip(&groups) {
            self.compute.set_bind_group(index, group, &[]);
        }
    }

    /// The dispatch parameters of a batch. Binds the jittered samples if the batch computes those.
    pub fn dispatch_params(&mut self, trace: &Trace, grid: &Grid) -> DispatchParams {
        let most = self.targets.batch_workgroups * WORKGROUP_BLOCKS;
        debug_assert!(trace.blocks <= most, "buffers hold one batch");
        let mut params = grid.dispatch_params(trace.first_block / WORKGROUP_BLOCKS);
        params.first_block = trace.first_block % WORKGROUP_BLOCKS;
        params.starts_at_surface = u32::from(trace.from > Stage::March);
        params.blocks = trace.blocks;
        params.queue_threads = Occupancy::of(self.layouts.gpu.cpu).queue_threads(trace.blocks);
        (params.kept_first, params.kept_end) = (trace.kept.first, trace.kept.end);
        if let Points::Samples { first, count } = trace.points {
            let skipped = self.inputs.sub_frame.map_or(0, |sub_frame| sub_frame.first_sample);
            params.jitter = lattice::jitter(first + skipped);
            params.samples = count;
            params.compact = 1;
            params.first_sample = first - FIRST_JITTERED + skipped;
            // Centre samples see the centres of lights and lens, and no bounced light: theirs would stay visible.
            let replaces = first == FIRST_JITTERED && self.inputs.replaces_center_samples();
            params.accumulate = u32::from(!replaces);
            self.compute.set_bind_group(1, &self.targets.jittered.group, &[]);
        }
        params
    }

    /// Adds dispatches over a whole grid but its `kept` pixels, for a lattice of `spacing` pixels.
    pub fn dispatch_grid(
        &mut self,
        pipeline: &PassPipeline,
        grid: &Grid,
        spacing: u32,
        kept: KeptPixels,
    ) {
        // Splits a grid that exceeds the limit of workgroups per dispatch.
        const MAX_DISPATCH_WORKGROUPS: u32 = 65_535;
        let total = grid.workgroups();
        for first in (0..total).step_by(MAX_DISPATCH_WORKGROUPS as usize) {
            let params = DispatchParams {
                spacing,
                kept_first: kept.first,
                kept_end: kept.end,
                ..grid.dispatch_params(first)
            };
            self.dispatch(pipeline, params, MAX_DISPATCH_WORKGROUPS.min(total - first));
        }
    }

    /// Adds a dispatch over all pixels of the region.
    pub fn dispatch_plane(&mut self, pipeline: &PassPipeline, params: DispatchParams) {
        self.dispatch_rows(pipeline, params, 0..u32::MAX);
    }

    /// Adds a dispatch over the pixels of some rows of workgroups; rows beyond the region are left out.
    pub fn dispatch_rows(
        &mut self,
        pipeline: &PassPipeline,
        params: DispatchParams,
        rows: Range<u32>,
    ) {
        let [columns, all_rows] =
            self.inputs.frame.size_px.map(|side| side.div_ceil(WORKGROUP_SIDE));
        let end = rows.end.min(all_rows);
        if rows.start < end {
            let params = DispatchParams { first_row: rows.start, ..params };
            self.dispatch_groups(pipeline, params, [columns, end - rows.start]);
        }
    }

    /// Adds a dispatch with one thread per pixel of a trace.
    pub fn dispatch_pixels(&mut self, pipeline: &PassPipeline, params: DispatchParams) {
        let pixels = (params.blocks * BLOCK_THREADS) >> params.samples_shift;
        self.dispatch(pipeline, params, pixels.div_ceil(WORKGROUP_THREADS));
    }

    /// Adds a dispatch over all blocks of a trace that queues some of the blocks.
    pub fn dispatch_blocks(
        &mut self,
        pipeline: &PassPipeline,
        work_queues: &wgpu::BindGroup,
        params: DispatchParams,
    ) {
        self.compute.set_bind_group(2, work_queues, &[]);
        self.dispatch(pipeline, params, params.blocks.div_ceil(WORKGROUP_THREADS));
    }

    /// Adds a dispatch over a work queue, which may write another queue.
    pub fn dispatch_queue(
        &mut self,
        pipeline: &PassPipeline,
        work_queues: &wgpu::BindGroup,
        params: DispatchParams,
        queue: Queue,
    ) {
        self.compute.set_bind_group(2, work_queues, &[]);
        if !self.prepare(pipeline, params) {
            return;
        }
        let (workgroups, offset) = match &self.rehearsal {
            Some(rehearsal) => (&rehearsal.no_workgroups, 0),
            None => self.targets.work_queues.workgroups(queue),
        };
        self.compute.dispatch_workgroups_indirect(workgroups, offset);
    }

    /// Adds a dispatch of `workgroups`.
    pub fn dispatch(&mut self, pipeline: &PassPipeline, params: DispatchParams, workgroups: u32) {
        self.dispatch_groups(pipeline, params, [workgroups, 1]);
    }

    fn dispatch_groups(
        &mut self,
        pipeline: &PassPipeline,
        params: DispatchParams,
        [columns, rows]: [u32; 2],
    ) {
        if !self.prepare(pipeline, params) {
            return;
        }
        if let Some(rehearsal) = &self.rehearsal {
            self.compute.dispatch_workgroups_indirect(&rehearsal.no_workgroups, 0);
            return;
        }
        self.compute.dispatch_workgroups(columns, rows, 1);
    }

    /// Sets the pipeline and the parameters of the next dispatch; false if a rehearsal leaves the pass out.
    fn prepare(&mut self, of: &PassPipeline, params: DispatchParams) -> bool {
        let Some(pipeline) = &of.pipeline else { return false };
        debug_assert!(
            self.recorded < MAX_DISPATCHES,
            "a submit has {MAX_DISPATCHES} dispatches at most"
        );
        let offset = self.recorded * DISPATCH_PARAMS_STRIDE_BYTES;
        // Queue writes and submits keep their order: earlier submits already have their own parameters.
        self.layouts.gpu.queue.write_buffer(
            &self.targets.dispatch_params,
            u64::from(offset),
            &params.to_bytes(),
        );
        self.recorded += 1;
        self.dispatches.add(of.pass, &params);
        self.compute.set_pipeline(pipeline);
        self.compute.set_bind_group(0, &self.targets.frame_group, &[offset]);
        true
    }

    /// The commands, ready for submission.
    pub fn finish(self) -> wgpu::CommandBuffer {
        drop(self.compute);
        self.encoder.finish()
    }
}
