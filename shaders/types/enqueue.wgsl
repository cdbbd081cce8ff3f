// For passes that write a work queue: the workgroup counts of the passes that read the queue.
// uses: lib/lattice, types/dispatch_params, types/work_queues

struct Workgroups {
    x: atomic<u32>,
    // Always 1.
    y: u32,
    z: u32,
}

// Bound for hits: entry 0 with one thread per point of a block, entry 1 with one thread per block. Bound
// for rays: one entry per ray queue, with one thread per ray.
@group(2) @binding(1) var<storage, read_write> workgroups_for: array<Workgroups, RAY_QUEUES>;

// Counts one more entry; `in_each` entries fill a workgroup.
fn count_workgroup(which: u32, entry: u32, in_each: u32) {
    if (entry % in_each == 0u) { atomicAdd(&workgroups_for[which].x, 1u); }
}

// Counts one more block, which fills a part of a workgroup or several workgroups.
fn count_block(which: u32, entry: u32) {
    if (dispatch.queue_threads < BLOCK_THREADS) {
        atomicAdd(&workgroups_for[which].x, BLOCK_THREADS / dispatch.queue_threads);
    } else {
        count_workgroup(which, entry, dispatch.queue_threads / BLOCK_THREADS);
    }
}

fn enqueue_hit(block: u32) {
    let entry = atomicAdd(&work_queues.hits, 1u);
    work_queues.entries[entry] = block;
    count_block(0u, entry);
    count_workgroup(1u, entry, WORKGROUP_THREADS);
}

fn enqueue_ray(block: u32, clear: f32) {
    let entry = atomicAdd(&work_queues.rays[dispatch.ray_queue], 1u);
    work_queues.entries[max_blocks() + entry] = block;
    work_queues.entries[2u * max_blocks() + entry] = bitcast<u32>(clear);
    count_block(dispatch.ray_queue, entry);
}

// Adds a sample to a ray queue, in a region of its entries.
fn enqueue_sample(region: u32, queue: u32, ray: u32) {
    let entry = atomicAdd(&work_queues.rays[queue], 1u);
    work_queues.entries[region_start(region) + entry] = ray;
    count_workgroup(queue, entry, dispatch.queue_threads);
}
