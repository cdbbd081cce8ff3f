//! Lists of the blocks of threads that a pass has work for: its dispatch is as large as its list.
//!
//! A block is eight threads: for one sample each of four by two neighbouring pixels, or for more samples
//! of fewer. Passes that write a list are
//! dispatched over all blocks of a trace or of another list, a thread each; the GPU itself counts
//! the workgroups of those that read it.

use super::{
    lattice::WORKGROUP_THREADS,
    pipelines::Pipelines,
    targets::{group, storage},
};
use crate::scene::MAX_LIGHTS;

/// Threads of a block; `BLOCK_THREADS` in `shaders/lib/lattice.wgsl`.
pub const BLOCK_THREADS: u32 = 8;

/// The camera's rays, and those to each light; `RAY_LISTS` in `shaders/types/lists.wgsl`.
pub const RAY_LISTS: usize = MAX_LIGHTS + 1;

/// Bytes of a counter.
const WORD: u64 = 4;

/// Arguments of an indirect dispatch.
type Workgroups = [u32; 3];

/// Arguments of a dispatch that nothing has been listed for yet.
const NONE_YET: Workgroups = [0, 1, 1];

const WORKGROUPS_BYTES: u64 = size_of::<Workgroups>() as u64;

/// The lists of one region's traces.
pub struct Lists {
    /// Counters and entries.
    blocks: wgpu::Buffer,
    /// Workgroups for hits: at a thread a point, at a thread a block.
    hit_workgroups: wgpu::Buffer,
    /// Workgroups for each ray list.
    ray_workgroups: wgpu::Buffer,
    /// For passes that read lists.
    pub reading: wgpu::BindGroup,
    /// For the pass that lists hits.
    pub listing_hits: wgpu::BindGroup,
    /// For passes that list rays.
    pub listing_rays: wgpu::BindGroup,
}

impl Lists {
    /// Room for every block of so many workgroups.
    pub fn new(pipelines: &Pipelines, workgroups: u32) -> Self {
        let (device, layouts) = (&pipelines.gpu.device, &pipelines.layouts);
        let most = u64::from(workgroups.max(1)) * u64::from(WORKGROUP_THREADS / BLOCK_THREADS);
        let counters = WORD * (RAY_LISTS as u64 + 1);
        let blocks = storage(device, "block lists", counters + 3 * WORD * most);
        let arguments = |label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: WORKGROUPS_BYTES * RAY_LISTS as u64,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::INDIRECT
                    | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let hit_workgroups = arguments("workgroups for hits");
        let ray_workgroups = arguments("workgroups for rays");
        let listing = |workgroups: &wgpu::Buffer| {
            let resources = [&blocks, workgroups].map(wgpu::Buffer::as_entire_binding);
            group(device, &layouts.listing, "listing", resources)
        };
        Self {
            reading: group(device, &layouts.listed, "listed", [blocks.as_entire_binding()]),
            listing_hits: listing(&hit_workgroups),
            listing_rays: listing(&ray_workgroups),
            blocks,
            hit_workgroups,
            ray_workgroups,
        }
    }

    /// Bytes of all of it.
    pub fn bytes(&self) -> u64 {
        self.blocks.size() + self.hit_workgroups.size() + self.ray_workgroups.size()
    }

    /// Empties the list of hits before the next submit.
    pub fn clear_hits(&self, queue: &wgpu::Queue) {
        queue.write_buffer(&self.blocks, 0, bytemuck::bytes_of(&0_u32));
        queue.write_buffer(&self.hit_workgroups, 0, bytemuck::bytes_of(&[NONE_YET; 2]));
    }

    /// Empties the ray lists before the next submit.
    pub fn clear_rays(&self, queue: &wgpu::Queue) {
        queue.write_buffer(&self.blocks, WORD, bytemuck::bytes_of(&[0_u32; RAY_LISTS]));
        let none_yet = [NONE_YET; RAY_LISTS];
        queue.write_buffer(&self.ray_workgroups, 0, bytemuck::cast_slice(&none_yet));
    }

    /// How many workgroups a pass has that reads a list.
    pub fn workgroups(&self, list: List) -> (&wgpu::Buffer, u64) {
        match list {
            List::HitPoints => (&self.hit_workgroups, 0),
            List::HitBlocks => (&self.hit_workgroups, WORKGROUPS_BYTES),
            List::Rays(list) => (&self.ray_workgroups, WORKGROUPS_BYTES * u64::from(list)),
        }
    }
}

/// A list that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum List {
    /// Blocks with surface points, a thread each point.
    HitPoints,
    /// The same, a thread each block.
    HitBlocks,
    /// A ray list, a thread each ray: 0 the camera's, then one for each light.
    Rays(u32),
}
