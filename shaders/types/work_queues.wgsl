// Work queues: the blocks of threads that a later pass has work for. Host twin: `render::work_queues`.
// uses: lib/lattice, types/dispatch_params

// One queue for camera rays, and one for the rays to each of 64 lights.
const RAY_QUEUES = 65u;

struct WorkQueues {
    // Number of blocks with surface points.
    hits: atomic<u32>,
    // Number of blocks with rays to march, in each queue.
    rays: array<atomic<u32>, RAY_QUEUES>,
    // In thirds: the blocks of `hits`; the blocks of the ray queue in use, since each queue is read before
    // the next is written; the distances up to which these rays are clear.
    entries: array<u32>,
}

@group(2) @binding(0) var<storage, read_write> work_queues: WorkQueues;

fn max_blocks() -> u32 {
    return arrayLength(&work_queues.entries) / 3u;
}

// A sample of a queued block.
struct QueuedSample {
    site: Site,
    // Distance up to which the block's rays are known to be clear; for ray queues only.
    clear: f32,
}

// A thread's sample of the block at an entry; each entry has eight consecutive threads.
fn queued(is_there: bool, entry: u32, thread: u32, clear: u32) -> QueuedSample {
    let block = select(0u, work_queues.entries[entry], is_there);
    var site = block_site(block_at(block), thread % BLOCK_THREADS);
    site.is_there = site.is_there && is_there;
    return QueuedSample(site, bitcast<f32>(clear));
}

fn queued_hit(thread: u32) -> Site {
    let entry = thread / BLOCK_THREADS;
    return queued(entry < atomicLoad(&work_queues.hits), entry, thread, 0u).site;
}

fn queued_ray(thread: u32) -> QueuedSample {
    let entry = thread / BLOCK_THREADS;
    let is_there = entry < atomicLoad(&work_queues.rays[dispatch.ray_queue]);
    let clear = select(0u, work_queues.entries[2u * max_blocks() + entry], is_there);
    return queued(is_there, max_blocks() + entry, thread, clear);
}
