// Mip levels of the region. An element of level n is the mean of the 2^n x 2^n pixels below it,
// or of as many of them as there are at the right and lower edges: each level has as many
// elements as it takes to cover the region.

// The finest level that is kept.
const FIRST_MIP_LEVEL = 2u;

fn mip_size(size_px: vec2u, level: u32) -> vec2u {
    return (size_px + ((1u << level) - 1u)) >> vec2u(level);
}

// The element of `mips` at which a level starts.
fn mip_start(size_px: vec2u, level: u32) -> u32 {
    var start = 0u;
    for (var finer = FIRST_MIP_LEVEL; finer < level; finer++) {
        let size = mip_size(size_px, finer);
        start += size.x * size.y;
    }
    return start;
}

// How many pixels an element spans along each axis.
fn mip_span(size_px: vec2u, level: u32, cell: vec2u) -> vec2u {
    return min((cell + 1u) << vec2u(level), size_px) - (cell << vec2u(level));
}

// A thread's number in a dispatch over a level's elements.
fn mip_index(workgroup: u32, local_index: u32) -> u32 {
    return (slice.first_workgroup + workgroup) * 64u + local_index;
}
