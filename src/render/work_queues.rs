//! Work queues: the blocks of threads that a pass has work for. A dispatch is as large as its queue.
//!
//! A block is eight threads: one sample each of 4×2 neighbouring pixels, or several samples of fewer pixels.
//! A pass that writes a queue runs over all blocks of a trace or of another queue, one thread per block; the
//! GPU counts the workgroups of the passes that read the queue.

use super::{
    buffers::{group, storage},
    lattice::WORKGROUP_THREADS,
    layouts::Layouts,
};
use crate::scene::MAX_LIGHTS;

/// Threads per block; `BLOCK_THREADS` in `shaders/lib/lattice.wgsl`.
pub const BLOCK_THREADS: u32 = 8;

/// One queue for camera rays and one per light; `RAY_QUEUES` in `shaders/types/work_queues.wgsl`.
pub const RAY_QUEUES: usize = MAX_LIGHTS + 1;

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
    blocks: wgpu::Buffer,
    /// Workgroup counts for hits: one thread per point, then one thread per block.
    hit_workgroups: wgpu::Buffer,
    /// Workgroup counts for each ray queue.
    ray_workgroups: wgpu::Buffer,
    /// Bound by passes that read a queue.
    pub dequeue: wgpu::BindGroup,
    /// Bound by the pass that writes the queue of hits.
    pub enqueue_hits: wgpu::BindGroup,
    /// Bound by passes that write ray queues.
    pub enqueue_rays: wgpu::BindGroup,
}

impl WorkQueues {
    /// Allocates queues for every block of `workgroups` workgroups.
    pub fn new(layouts: &Layouts, workgroups: u32) -> Self {
        let device = &layouts.gpu.device;
        let most = u64::from(workgroups.max(1)) * u64::from(WORKGROUP_THREADS / BLOCK_THREADS);
        let counters = WORD * (RAY_QUEUES as u64 + 1);
        let blocks = storage(device, "work queues", counters + 3 * WORD * most);
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
        let ray_workgroups = arguments("workgroups for rays");
        let enqueue = |workgroups: &wgpu::Buffer| {
            let resources = [&blocks, workgroups].map(wgpu::Buffer::as_entire_binding);
            group(device, &layouts.enqueue, "enqueue", resources)
        };
        Self {
            dequeue: group(device, &layouts.dequeue, "dequeue", [blocks.as_entire_binding()]),
            enqueue_hits: enqueue(&hit_workgroups),
            enqueue_rays: enqueue(&ray_workgroups),
            blocks,
            hit_workgroups,
            ray_workgroups,
        }
    }

    /// GPU memory of the queues, in bytes.
    pub fn bytes(&self) -> u64 {
        self.blocks.size() + self.hit_workgroups.size() + self.ray_workgroups.size()
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
        queue.write_buffer(&self.ray_workgroups, 0, bytemuck::cast_slice(&none_yet));
    }

    /// Dispatch arguments of a pass that reads `queue`: buffer and byte offset.
    pub fn workgroups(&self, queue: Queue) -> (&wgpu::Buffer, u64) {
        match queue {
            Queue::HitPoints => (&self.hit_workgroups, 0),
            Queue::HitBlocks => (&self.hit_workgroups, WORKGROUPS_BYTES),
            Queue::Rays(index) => (&self.ray_workgroups, WORKGROUPS_BYTES * u64::from(index)),
        }
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
    /// A ray queue, one thread per ray: 0 for camera rays, then one per light.
    Rays(u32),
}
