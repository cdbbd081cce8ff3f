//! Work queues: the blocks of threads that a pass has work for. Dispatches are as large as their queue.
//!
//! A block is eight threads: one sample each of 4×2 neighbouring pixels, or more samples of fewer pixels.
//! Passes that write a queue run over all blocks of a trace or of another queue, a thread a block; the GPU
//! counts the workgroups of the passes that read it.

use super::{
    lattice::WORKGROUP_THREADS,
    pipelines::Pipelines,
    targets::{group, storage},
};
use crate::scene::MAX_LIGHTS;

/// Threads of a block; `BLOCK_THREADS` in `shaders/lib/lattice.wgsl`.
pub const BLOCK_THREADS: u32 = 8;

/// The camera's rays, and those to each light; `RAY_QUEUES` in `shaders/types/work_queues.wgsl`.
pub const RAY_QUEUES: usize = MAX_LIGHTS + 1;

/// Bytes of a counter.
const WORD: u64 = 4;

/// Arguments of an indirect dispatch.
type Workgroups = [u32; 3];

/// Arguments of a dispatch whose queue is empty.
const NONE_YET: Workgroups = [0, 1, 1];

const WORKGROUPS_BYTES: u64 = size_of::<Workgroups>() as u64;

/// The queues of one region's traces.
pub struct WorkQueues {
    /// Counters and entries.
    blocks: wgpu::Buffer,
    /// Workgroups for hits: at a thread a point, at a thread a block.
    hit_workgroups: wgpu::Buffer,
    /// Workgroups for each ray queue.
    ray_workgroups: wgpu::Buffer,
    /// For passes that read a queue.
    pub reading: wgpu::BindGroup,
    /// For the pass that writes the queue of hits.
    pub enqueue_hits: wgpu::BindGroup,
    /// For passes that write ray queues.
    pub enqueue_rays: wgpu::BindGroup,
}

impl WorkQueues {
    /// Room for every block of so many workgroups.
    pub fn new(pipelines: &Pipelines, workgroups: u32) -> Self {
        let (device, layouts) = (&pipelines.gpu.device, &pipelines.layouts);
        let most = u64::from(workgroups.max(1)) * u64::from(WORKGROUP_THREADS / BLOCK_THREADS);
        let counters = WORD * (RAY_QUEUES as u64 + 1);
        let blocks = storage(device, "block work_queues", counters + 3 * WORD * most);
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
            reading: group(device, &layouts.dequeue, "queued", [blocks.as_entire_binding()]),
            enqueue_hits: enqueue(&hit_workgroups),
            enqueue_rays: enqueue(&ray_workgroups),
            blocks,
            hit_workgroups,
            ray_workgroups,
        }
    }

    /// Bytes of all of it.
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

    /// Workgroups of a pass that reads a queue: buffer and offset of its dispatch arguments.
    pub fn workgroups(&self, queue: Queue) -> (&wgpu::Buffer, u64) {
        match queue {
            Queue::HitPoints => (&self.hit_workgroups, 0),
            Queue::HitBlocks => (&self.hit_workgroups, WORKGROUPS_BYTES),
            Queue::Rays(index) => (&self.ray_workgroups, WORKGROUPS_BYTES * u64::from(index)),
        }
    }
}

/// A queue to read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Queue {
    /// Blocks with surface points, a thread each point.
    HitPoints,
    /// The same, a thread each block.
    HitBlocks,
    /// A ray queue, a thread a ray: 0 the camera's, then one for each light.
    Rays(u32),
}
