// Work queues: what a later pass has work for, either blocks of threads or single samples of a batch. Host twin:
// `render::work_queues`.
// uses: lib/lattice, types/dispatch_params, types/gbuffer

// Direct light: one queue for camera rays, and one for the rays to each of 64 lights. Paths: one queue for the rays of
// each vertex, from the camera to beyond the last of 64 bounces, each followed by one for the vertex's shadow rays.
const RAY_QUEUES = 132u;

struct WorkQueues {
    // Number of blocks with surface points.
    hits: atomic<u32>,
    // Number of entries in each ray queue.
    rays: array<atomic<u32>, RAY_QUEUES>,
    // The blocks of `hits`; the blocks of the ray queue in use, since each queue is read before the next is written; the
    // distances up to which these rays are clear. For paths, then three regions of samples.
    entries: array<u32>,
}

@group(2) @binding(0) var<storage, read_write> work_queues: WorkQueues;

fn max_blocks() -> u32 {
    return arrayLength(&rays) / BLOCK_THREADS;
}

// Regions of `entries`. Path rays alternate between regions 1 and 2: a vertex reads one and writes the other.
const BLOCK_REGION = 0u;
const SHADOW_REGION = 3u;

// Whether the dispatch's queue holds single samples of paths, not blocks.
fn is_path_queue() -> bool {
    return dispatch.queue_region != BLOCK_REGION;
}

// The region that the next vertex reads.
fn next_region() -> u32 {
    return 1u + (dispatch.bounce & 1u);
}

// Index of a region's first entry.
fn region_start(region: u32) -> u32 {
    return (3u + (region - 1u) * BLOCK_THREADS) * max_blocks();
}

// A thread's slot in a queue.
struct QueueSlot {
    // False for threads of a workgroup that compute no sample.
    is_active: bool,
    // Number of the thread among those that do.
    index: u32,
}

fn queue_slot(thread: u32) -> QueueSlot {
    let in_workgroup = thread % WORKGROUP_THREADS;
    let before = thread / WORKGROUP_THREADS * dispatch.queue_threads;
    return QueueSlot(in_workgroup < dispatch.queue_threads, before + in_workgroup);
}

// A sample of a queued block.
struct QueuedSample {
    site: Site,
    // Distance up to which the block's rays are known to be clear; for ray queues only.
    clear: f32,
}

// A slot's sample of a queue of `count` blocks, whose entries start at `start`: each entry has eight consecutive slots.
fn block_sample(slot: QueueSlot, start: u32, count: u32) -> Site {
    let entry = slot.index / BLOCK_THREADS;
    let is_there = slot.is_active && entry < count;
    let block = select(0u, work_queues.entries[start + entry], is_there);
    var site = block_site(block_at(block), slot.index % BLOCK_THREADS);
    site.is_there = site.is_there && is_there;
    return site;
}

// A thread's sample of the dispatch's queue of samples.
fn queued_sample(thread: u32) -> Site {
    let slot = queue_slot(thread);
    let is_there = slot.is_active && slot.index < atomicLoad(&work_queues.rays[dispatch.ray_queue]);
    let ray = select(0u, work_queues.entries[region_start(dispatch.queue_region) + slot.index], is_there);
    var site = block_site(block_at(ray / BLOCK_THREADS), ray % BLOCK_THREADS);
    site.is_there = site.is_there && is_there;
    return site;
}

fn queued_hit(thread: u32) -> Site {
    if (is_path_queue()) { return queued_sample(thread); }
    return block_sample(queue_slot(thread), 0u, atomicLoad(&work_queues.hits));
}

fn queued_ray(thread: u32) -> QueuedSample {
    if (is_path_queue()) {
        let site = queued_sample(thread);
        // A point's own surface does not shade it.
        return QueuedSample(site, rays[site.ray].radius / frame.march.shadow_margin);
    }
    let slot = queue_slot(thread);
    let site = block_sample(slot, max_blocks(), atomicLoad(&work_queues.rays[dispatch.ray_queue]));
    let clear = select(0u, work_queues.entries[2u * max_blocks() + slot.index / BLOCK_THREADS], site.is_there);
    return QueuedSample(site, bitcast<f32>(clear));
}

// A thread's sample of a pass over the vertices of paths: all samples of the batch at first, then those of a queue.
fn path_site(thread: u32) -> Site {
    if (is_path_queue()) { return queued_sample(thread); }
    var site = block_site(block_at(thread / BLOCK_THREADS), thread % BLOCK_THREADS);
    site.is_there = site.is_there && thread / BLOCK_THREADS < dispatch.blocks;
    return site;
}
