//! Work queues: the blocks of threads that a pass has work for. A dispatch is as large as its queue.
//!
//! A block is eight threads: one sample each of 4×2 neighbouring pixels, or several samples of fewer pixels.
//! A pass that writes a queue runs over all blocks of a trace or of another queue, one thread per block; the
//! GPU counts the workgroups of the passes that read the queue.

use super::{
    buffers::{group, storage},
    lattice::{BLOCK_THREADS, WORKGROUP_BLOCKS},
    layouts::Layouts,
};
use crate::scene::{MAX_LIGHTS, param};

/// Number of ray queues; `RAY_QUEUES` in `shaders/types/work_queues.wgsl`.
///
/// Direct light needs one for camera rays and one per light. Paths need two per vertex, from the camera to beyond the
/// last bounce: one for rays, one for shadow rays.
pub const RAY_QUEUES: usize = 2 * (MAX_BOUNCES as usize + 2);

const _: () = assert!(RAY_QUEUES > MAX_LIGHTS);

/// Greatest number of bounces.
const MAX_BOUNCES: u32 = param::BOUNCES.max as u32;

/// Regions of single samples that paths need: two of rays in turn, and one of shadow rays.
const SAMPLE_REGIONS: u64 = 3;

/// Bytes per counter.
const WORD: u64 = 4;

/// Arguments of an indirect dispatch.
type Workgroups = [u32; 3];

/// Arguments of a dispatch whose queue is empty.
const NONE_YET: Workgroups = [0, 1, 1];

const WORKGROUPS_BYTES: u64 = size_of::<Workgroups>() as u64;

/// The work queues between the passes of a batch.
pub struct WorkQueues {
    /// Counters and entries.
    pub blocks: wgpu::Buffer,
    /// Workgroup counts for hits: one thread per point, then one thread per block.
    hit_workgroups: wgpu::Buffer,
    /// Workgroup counts for each ray queue. The vertices of paths use both in turn: a dispatch can't write the buffer
    /// that holds its own count.
    ray_workgroups: [wgpu::Buffer; 2],
    /// Whether there are regions of samples for paths.
    pub for_paths: bool,
    /// Bound by passes that read a queue.
    pub dequeue: wgpu::BindGroup,
    /// Bound by the pass that writes the queue of hits.
    pub enqueue_hits: wgpu::BindGroup,
    /// Bound by passes that write ray queues.
    pub enqueue_rays: wgpu::BindGroup,
    /// Bound by the pass that writes the ray queues of even vertices, and of odd ones.
    enqueue_vertices: [wgpu::BindGroup; 2],
}

impl WorkQueues {
    /// Offset of the counters of the last two ray queues in [`Self::blocks`], bytes.
    ///
    /// Only paths with most bounces use those queues.
    pub const LAST_COUNTERS: u64 = WORD * (RAY_QUEUES as u64 - 1);

    /// Allocates queues for every block of `workgroups` workgroups, and regions of their samples for paths.
    pub fn new(layouts: &Layouts, workgroups: u32, for_paths: bool) -> Self {
        let device = &layouts.gpu.device;
        let most = u64::from(workgroups.max(1)) * u64::from(WORKGROUP_BLOCKS);
        let counters = WORD * (RAY_QUEUES as u64 + 1);
        let regions = if for_paths { SAMPLE_REGIONS * u64::from(BLOCK_THREADS) } else { 0 };
        let blocks = storage(device, "work queues", counters + (3 + regions) * WORD * most);
        let arguments = |label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: WORKGROUPS_BYTES * RAY_QUEUES as u64,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::INDIRECT
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let hit_workgroups = arguments("workgroups for hits");
        let ray_workgroups = ["workgroups for rays", "workgroups for odd vertices"].map(arguments);
        let enqueue = |workgroups: &wgpu::Buffer| {
            let resources = [&blocks, workgroups].map(wgpu::Buffer::as_entire_binding);
            group(device, &layouts.enqueue, "enqueue", resources)
        };
        Self {
            dequeue: group(device, &layouts.dequeue, "dequeue", [blocks.as_entire_binding()]),
            enqueue_hits: enqueue(&hit_workgroups),
            enqueue_rays: enqueue(&ray_workgroups[0]),
            enqueue_vertices: ray_workgroups.each_ref().map(enqueue),
            blocks,
            hit_workgroups,
            ray_workgroups,
            for_paths,
        }
    }

    /// GPU memory of the queues, in bytes.
    pub fn bytes(&self) -> u64 {
        let of_rays = self.ray_workgroups.iter().map(wgpu::Buffer::size).sum::<u64>();
        self.blocks.size() + self.hit_workgroups.size() + of_rays
    }

    /// Empties the queue of hits before the next submit.
    pub fn clear_hits(&self, queue: &wgpu::Queue) {
        queue.write_buffer(&self.blocks, 0, bytemuck::bytes_of(&0_u32));
        queue.write_buffer(&self.hit_workgroups, 0, bytemuck::bytes_of(&[NONE_YET; 2]));
    }

    /// Empties the ray queues before the next submit.
    pub fn clear_rays(&self, queue: &wgpu::Queue) {
        queue.write_buffer(&self.blocks, WORD, bytemuck::bytes_of(&[0_u32; RAY_QUEUES]));
        let none_yet = [NONE_YET; RAY_QUEUES];
        for workgroups in &self.ray_workgroups {
            queue.write_buffer(workgroups, 0, bytemuck::cast_slice(&none_yet));
        }
    }

    /// Dispatch arguments of a pass that reads `queue`: buffer and byte offset.
    pub fn workgroups(&self, queue: Queue) -> (&wgpu::Buffer, u64) {
        match queue {
            Queue::HitPoints => (&self.hit_workgroups, 0),
            Queue::HitBlocks => (&self.hit_workgroups, WORKGROUPS_BYTES),
            Queue::Rays(index) => (&self.ray_workgroups[0], WORKGROUPS_BYTES * u64::from(index)),
            Queue::Vertex(rays) => {
                let of_vertex = &self.ray_workgroups[rays.vertex() as usize % 2];
                (of_vertex, WORKGROUPS_BYTES * u64::from(rays.queue()))
            }
        }
    }

    /// Bound by the pass that scatters paths at their vertex `bounce`: it writes shadow rays, and the next vertex's rays.
    pub fn enqueue_after(&self, bounce: u32) -> &wgpu::BindGroup {
        &self.enqueue_vertices[(bounce as usize + 1) % 2]
    }
}

/// The ray queue of camera rays; those of lights follow.
pub const CAMERA_RAYS: u32 = 0;

/// A queue that a pass reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Queue {
    /// Blocks with surface points, one thread per point.
    HitPoints,
    /// Blocks with surface points, one thread per block.
    HitBlocks,
    /// A ray queue of direct light, one thread per ray: 0 for camera rays, then one per light.
    Rays(u32),
    /// A queue of paths, one thread per ray.
    Vertex(VertexRays),
}

/// The rays to or from the vertices of paths that have been scattered so many times before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexRays {
    /// The rays that find the vertices; 0: those of the camera, queued in blocks.
    Paths(u32),
    /// Rays from the vertices to their chosen lights.
    Shadows(u32),
}

impl VertexRays {
    /// Number of the ray queue.
    pub fn queue(self) -> u32 {
        match self {
            Self::Paths(bounce) => 2 * bounce,
            Self::Shadows(bounce) => 2 * bounce + 1,
        }
    }

    /// The region of the queue's entries: see `shaders/types/work_queues.wgsl`.
    pub fn region(self) -> u32 {
        match self {
            Self::Paths(0) => 0,
            Self::Paths(bounce) => 1 + (bounce - 1) % 2,
            Self::Shadows(_) => 3,
        }
    }

    /// The vertex that the rays are marched before.
    fn vertex(self) -> u32 {
        match self {
            Self::Paths(bounce) => bounce,
            Self::Shadows(bounce) => bounce + 1,
        }
    }
}
