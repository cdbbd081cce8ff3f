// Which sample of which pixel a thread works on. Threads run over a grid that is a lattice of the region:
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

// A workgroup's threads in the order of their index make eight blocks: rays of one go in one
// bundle. Of single samples a block has four by two pixels; of samples that are computed together, all
// those of two by two, of two, or of a single pixel.
const BLOCKS = 8u;
const BLOCK_THREADS = 8u;

// The logarithms of a block's width and height, in pixels.
fn block_shift() -> vec2u {
    return vec2u(2u - (slice.samples_shift + 1u) / 2u, 1u - slice.samples_shift / 2u);
}

// A block's first pixel in its workgroup.
fn place_of_block(block: u32) -> vec2u {
    return vec2u(block & 1u, block >> 1u) << block_shift();
}

// What is left of `a` over `b`, both below 2^27, and b > 0. CPUs divide integers one lane at a time: here
// the quotient comes by way of f32, whose error of one at most is put right.
fn remainder(a: vec2u, b: vec2u) -> vec2u {
    let quotient = vec2u(vec2f(a) / vec2f(b));
    let rest = bitcast<vec2i>(a - quotient * b);
    let low = select(rest, rest + vec2i(b), rest < vec2i(0));
    return vec2u(select(low, low - vec2i(b), low >= vec2i(b)));
}

// The place of a workgroup's first thread in the lattice's grid.
fn workgroup_corner(workgroup: u32) -> vec2u {
    let id = slice.first_workgroup + workgroup;
    let column = remainder(vec2u(id), slice.workgroups).x;
    // Without a rest, this division is exact enough.
    let row = u32(round(f32(id - column) / f32(slice.workgroups.x)));
    // Each column begins elsewhere: a row at a time would show as stripes.
    let across = remainder(vec2u(column * slice.scatter.x), slice.workgroups).x;
    let down = remainder(vec2u((row + across) * slice.scatter.y), slice.workgroups).y;
    return vec2u(across, down) * (vec2u(2u, 4u) << block_shift());
}

// A block of a trace.
struct Block {
    // Counted from the trace's first.
    index: u32,
    // The place of its first pixel in the lattice's grid.
    corner: vec2u,
}

fn block_at(index: u32) -> Block {
    return Block(index, workgroup_corner(index / BLOCKS) + place_of_block(index % BLOCKS));
}

struct PixelBox {
    // The pixels at its upper left and its lower right.
    first: vec2u,
    last: vec2u,
}

// The pixels that hold those of a block; they may lie outside of the region.
fn block_box(block: Block) -> PixelBox {
    let first = block.corner * slice.step + slice.offset;
    let last = first + ((vec2u(1u) << block_shift()) - 1u) * slice.step + vec2u(slice.stagger, 0u);
    return PixelBox(first << vec2u(slice.shift), last << vec2u(slice.shift));
}

// The pixel in the region at a place of the lattice's grid; it may lie outside of it.
fn pixel_at(place: vec2u) -> vec2u {
    let shifted = slice.stagger * ((place.y + slice.row_phase) & 1u);
    return (place * slice.step + slice.offset + vec2u(shifted, 0u)) << vec2u(slice.shift);
}

// The pixel of a thread where each has one of its own; it may lie outside of the region.
fn lattice_pixel(workgroup: u32, local_index: u32) -> vec2u {
    return pixel_at(workgroup_corner(workgroup) + place_in_workgroup(local_index));
}

fn inside_region(pixel: vec2u) -> bool {
    return all(pixel < frame.size_px);
}

// The element of film arrays that belongs to a pixel.
fn pixel_index(pixel: vec2u) -> u32 {
    return pixel.y * frame.size_px.x + pixel.x;
}

// A sample: what a thread of a block computes.
struct Site {
    // Whether there is one: a pixel of the region, and no more of its samples than are asked for.
    is_there: bool,
    pixel: vec2u,
    // Which of those that are computed together.
    sample: u32,
    // Its element of G-buffer arrays.
    index: u32,
}

// A block's sample, 0 to 7: the pixels of a block come first, then their next samples.
fn block_site(block: Block, place: u32) -> Site {
    let pixels_shift = 3u - slice.samples_shift;
    let sample = place >> pixels_shift;
    let in_block = place & ((1u << pixels_shift) - 1u);
    let width_shift = block_shift().x;
    let at = vec2u(in_block & ((1u << width_shift) - 1u), in_block >> width_shift);
    let pixel = pixel_at(block.corner + at);
    let packed = block.index * BLOCK_THREADS + place;
    let index = select(pixel_index(pixel), packed, slice.compact != 0u);
    return Site(inside_region(pixel) && sample < slice.samples, pixel, sample, index);
}

// The first sample of the pixel of a thread that goes through all samples of one pixel.
fn pixel_site(thread: u32) -> Site {
    let pixels_shift = 3u - slice.samples_shift;
    let block = thread >> pixels_shift;
    var site = block_site(block_at(block), thread & ((1u << pixels_shift) - 1u));
    site.is_there = site.is_there && block < slice.blocks;
    return site;
}

// Another sample of the pixel of `first`.
fn sample_site(first: Site, sample: u32) -> Site {
    let on = select(0u, sample << (3u - slice.samples_shift), slice.compact != 0u);
    return Site(first.is_there, first.pixel, sample, first.index + on);
}

// Where in its pixel a sample lies, 0 to 1.
fn place_in_pixel(sample: u32) -> vec2f {
    return fract(slice.jitter + f32(sample) * slice.jitter_step);
}
