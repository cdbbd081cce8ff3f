// For passes that write the lists: how many workgroups the passes that read them have.

struct Workgroups {
    x: atomic<u32>,
    // Always 1.
    y: u32,
    z: u32,
}

// Of a list of hits: at a thread for each of a block's points, and at a thread a block. Of ray
// lists: one each, at a thread a ray.
@group(2) @binding(1) var<storage, read_write> workgroups_for: array<Workgroups, RAY_LISTS>;

// One more of what goes into workgroups of so many.
fn count_workgroup(which: u32, entry: u32, in_each: u32) {
    if (entry % in_each == 0u) { atomicAdd(&workgroups_for[which].x, 1u); }
}

fn list_hit(block: u32) {
    let entry = atomicAdd(&lists.hits, 1u);
    lists.entries[entry] = block;
    count_workgroup(0u, entry, BLOCKS);
    count_workgroup(1u, entry, WORKGROUP_THREADS);
}

fn list_ray(block: u32, clear: f32) {
    let entry = atomicAdd(&lists.rays[slice.ray_list], 1u);
    lists.entries[most_blocks() + entry] = block;
    lists.entries[2u * most_blocks() + entry] = bitcast<u32>(clear);
    count_workgroup(slice.ray_list, entry, BLOCKS);
}
