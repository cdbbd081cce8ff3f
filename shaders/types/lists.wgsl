// Blocks of threads that a later pass has work for, so that it spends nothing on the others. Host
// twin: `render::lists`.

// The camera's rays, and those to each of 64 lights.
const RAY_LISTS = 65u;

struct Lists {
    // How many blocks with surface points there are.
    hits: atomic<u32>,
    // How many blocks with rays to march, in each list.
    rays: array<atomic<u32>, RAY_LISTS>,
    // In thirds: the blocks of `hits`; those of the ray list that is in use, for each is read before
    // the next is written; how far their rays are known to be clear.
    entries: array<u32>,
}

@group(2) @binding(0) var<storage, read_write> lists: Lists;

fn most_blocks() -> u32 {
    return arrayLength(&lists.entries) / 3u;
}

// A sample of a listed block.
struct Listed {
    site: Site,
    // How far its block's rays are known to be clear; of ray lists only.
    clear: f32,
}

// A thread's sample of the block at an entry: each entry's eight threads come one after the other.
fn listed(is_there: bool, entry: u32, thread: u32, clear: u32) -> Listed {
    let block = select(0u, lists.entries[entry], is_there);
    var site = block_site(block_at(block), thread % BLOCK_THREADS);
    site.is_there = site.is_there && is_there;
    return Listed(site, bitcast<f32>(clear));
}

fn listed_hit(thread: u32) -> Site {
    let entry = thread / BLOCK_THREADS;
    return listed(entry < atomicLoad(&lists.hits), entry, thread, 0u).site;
}

fn listed_ray(thread: u32) -> Listed {
    let entry = thread / BLOCK_THREADS;
    let is_there = entry < atomicLoad(&lists.rays[slice.ray_list]);
    let clear = select(0u, lists.entries[2u * most_blocks() + entry], is_there);
    return listed(is_there, most_blocks() + entry, thread, clear);
}
