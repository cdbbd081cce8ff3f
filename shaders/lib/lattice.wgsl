// Which pixel a thread works on. Threads run over a grid that is a lattice of the region:
// every 2^shift-th pixel, every other one of those in staggered rows, and so on.

const WORKGROUP_SIDE = 8u;
const WORKGROUP_THREADS = 64u;

// A thread's place in its 8x8 workgroup: 4x2 tiles, so that neighbours in a SIMD group are
// neighbours in the picture.
fn place_in_workgroup(local_index: u32) -> vec2u {
    let x = (local_index & 3u) | ((local_index >> 1u) & 4u);
    let y = ((local_index >> 2u) & 1u) | ((local_index >> 3u) & 6u);
    return vec2u(x, y);
}

// A workgroup's threads in the order of their index make eight blocks of four by two: rays of one
// go in one bundle.
const BLOCKS = 8u;
const BLOCK_THREADS = 8u;
const BLOCK_SIZE = vec2u(4u, 2u);

// The place of a block's first thread in its workgroup.
fn place_of_block(block: u32) -> vec2u {
    return place_in_workgroup(block * BLOCK_THREADS);
}

// The place of a workgroup's first thread in the lattice's grid.
fn workgroup_corner(workgroup: u32) -> vec2u {
    let id = slice.first_workgroup + workgroup;
    let place = vec2u(id % slice.workgroups.x, id / slice.workgroups.x);
    return (place * slice.scatter) % slice.workgroups * WORKGROUP_SIDE;
}

struct PixelBox {
    // The pixels at its upper left and its lower right.
    first: vec2u,
    last: vec2u,
}

// The pixels that hold those of a workgroup's block; they may lie outside of the region.
fn block_box(workgroup: u32, block: u32) -> PixelBox {
    let thread = workgroup_corner(workgroup) + place_of_block(block);
    let first = thread * slice.step + slice.offset;
    let last = first + (BLOCK_SIZE - 1u) * slice.step + vec2u(slice.stagger, 0u);
    return PixelBox(first << vec2u(slice.shift), last << vec2u(slice.shift));
}

// The thread's pixel in the region; it may lie outside of it.
fn lattice_pixel(workgroup: u32, local_index: u32) -> vec2u {
    let thread = workgroup_corner(workgroup) + place_in_workgroup(local_index);
    let shifted = slice.stagger * ((thread.y + slice.row_phase) & 1u);
    return (thread * slice.step + slice.offset + vec2u(shifted, 0u)) << vec2u(slice.shift);
}

fn inside_region(pixel: vec2u) -> bool {
    return all(pixel < picture.size_px);
}

// The element of film arrays that belongs to a pixel.
fn pixel_index(pixel: vec2u) -> u32 {
    return pixel.y * picture.size_px.x + pixel.x;
}

// The element of G-buffer arrays that a thread reads and writes.
fn sample_index(pixel: vec2u, workgroup: u32, local_index: u32) -> u32 {
    return select(pixel_index(pixel), workgroup * WORKGROUP_THREADS + local_index, slice.compact != 0u);
}
