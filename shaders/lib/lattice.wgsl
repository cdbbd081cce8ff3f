// The pixel and sample of each thread. Threads run over a grid, a lattice of the region: every 2^shift-th
// pixel, or every other one of those in staggered rows, and so on.
// uses: types/dispatch_params, types/frame_uniforms

const WORKGROUP_SIDE = 8u;
const WORKGROUP_THREADS = 64u;

// A thread's position in its 8x8 workgroup: 4x2 tiles, so that neighbours in a SIMD group are
// neighbours in the picture.
fn place_in_workgroup(local_index: u32) -> vec2u {
    let x = (local_index & 3u) | ((local_index >> 1u) & 4u);
    let y = ((local_index >> 2u) & 1u) | ((local_index >> 3u) & 6u);
    return vec2u(x, y);
}

// The pixel of a thread in a dispatch over rows of pixels.
fn pixel_of_rows(workgroup: vec2u, local_index: u32) -> vec2u {
    return WORKGROUP_SIDE * (workgroup + vec2u(0u, dispatch.first_row)) + place_in_workgroup(local_index);
}

// A workgroup's threads form eight blocks, in the order of their index; a block's rays march as one
// cone. With single samples a block covers four by two pixels; with several samples per pixel it
// covers all samples of two by two pixels, of two pixels, or of one.
const BLOCKS = 8u;
const BLOCK_THREADS = 8u;

// The logarithms of a block's width and height, in pixels.
fn block_shift() -> vec2u {
    return vec2u(2u - (dispatch.samples_shift + 1u) / 2u, 1u - dispatch.samples_shift / 2u);
}

// Offset of a block's first pixel in its workgroup.
fn place_of_block(block: u32) -> vec2u {
    return vec2u(block & 1u, block >> 1u) << block_shift();
}

// a mod b, for a and b below 2^27 and b > 0. CPUs divide integers one lane at a time, so the quotient
// is computed in f32 and its error of at most one corrected.
fn remainder(a: vec2u, b: vec2u) -> vec2u {
    let quotient = vec2u(vec2f(a) / vec2f(b));
    let rest = bitcast<vec2i>(a - quotient * b);
    let low = select(rest, rest + vec2i(b), rest < vec2i(0));
    return vec2u(select(low, low - vec2i(b), low >= vec2i(b)));
}

// Position of a workgroup's first thread in the lattice's grid.
fn workgroup_corner(workgroup: u32) -> vec2u {
    let id = dispatch.first_workgroup + workgroup;
    let column = remainder(vec2u(id), dispatch.workgroups).x;
    // The division has no remainder, so f32 is exact enough.
    let row = u32(round(f32(id - column) / f32(dispatch.workgroups.x)));
    // Each column starts at another row: whole rows in turn would show as stripes.
    let across = remainder(vec2u(column * dispatch.scatter.x), dispatch.workgroups).x;
    let down = remainder(vec2u((row + across) * dispatch.scatter.y), dispatch.workgroups).y;
    return vec2u(across, down) * (vec2u(2u, 4u) << block_shift());
}

// A block of the dispatch.
struct Block {
    // Counted from the first block of the dispatch.
    index: u32,
    // Position of the block's first pixel in the lattice's grid.
    corner: vec2u,
}

fn block_at(index: u32) -> Block {
    let at = dispatch.first_block + index;
    return Block(index, workgroup_corner(at / BLOCKS) + place_of_block(at % BLOCKS));
}

struct PixelBox {
    // The upper left and the lower right pixel.
    first: vec2u,
    last: vec2u,
}

// The bounding box of a block's pixels; it may extend past the region.
fn block_box(block: Block) -> PixelBox {
    let first = block.corner * dispatch.step + dispatch.offset;
    let last = first + ((vec2u(1u) << block_shift()) - 1u) * dispatch.step + vec2u(dispatch.stagger, 0u);
    return PixelBox(first << vec2u(dispatch.shift), last << vec2u(dispatch.shift));
}

// The pixel at a position of the lattice's grid; it may lie outside the region.
fn pixel_at(place: vec2u) -> vec2u {
    let shifted = dispatch.stagger * ((place.y + dispatch.row_phase) & 1u);
    return (place * dispatch.step + dispatch.offset + vec2u(shifted, 0u)) << vec2u(dispatch.shift);
}

// The pixel of a thread, with one thread per pixel; it may lie outside the region.
fn lattice_pixel(workgroup: u32, local_index: u32) -> vec2u {
    return pixel_at(workgroup_corner(workgroup) + place_in_workgroup(local_index));
}

fn inside_region(pixel: vec2u) -> bool {
    return all(pixel < frame.size_px);
}

// Whether a pixel already holds what the dispatch would compute.
fn is_kept(pixel: vec2u) -> bool {
    return all(pixel >= dispatch.kept_first) && all(pixel < dispatch.kept_end);
}

// The index of a pixel in film arrays.
fn pixel_index(pixel: vec2u) -> u32 {
    return pixel.y * frame.size_px.x + pixel.x;
}

// A sample, which one thread of a block computes.
struct Site {
    // False for pixels outside the region or kept, and for samples past the requested number.
    is_there: bool,
    pixel: vec2u,
    // Index among the samples of the pixel that are computed together.
    sample: u32,
    // Index in G-buffer arrays.
    index: u32,
    // Index of its ray: samples of a batch are counted in the order of their threads.
    ray: u32,
}

// A block's sample, 0 to 7: first one sample of each of the block's pixels, then their next samples.
fn block_site(block: Block, place: u32) -> Site {
    let pixels_shift = 3u - dispatch.samples_shift;
    let sample = place >> pixels_shift;
    let in_block = place & ((1u << pixels_shift) - 1u);
    let width_shift = block_shift().x;
    let at = vec2u(in_block & ((1u << width_shift) - 1u), in_block >> width_shift);
    let pixel = pixel_at(block.corner + at);
    let ray = block.index * BLOCK_THREADS + place;
    let index = select(pixel_index(pixel), ray, dispatch.compact != 0u);
    let is_there = inside_region(pixel) && !is_kept(pixel) && sample < dispatch.samples;
    return Site(is_there, pixel, sample, index, ray);
}

// The first sample of a pixel whose thread loops over all samples of the pixel.
fn pixel_site(thread: u32) -> Site {
    let pixels_shift = 3u - dispatch.samples_shift;
    let block = thread >> pixels_shift;
    var site = block_site(block_at(block), thread & ((1u << pixels_shift) - 1u));
    site.is_there = site.is_there && block < dispatch.blocks;
    return site;
}

// Another sample of the pixel of `first`.
fn sample_site(first: Site, sample: u32) -> Site {
    let on = sample << (3u - dispatch.samples_shift);
    let index = first.index + select(0u, on, dispatch.compact != 0u);
    return Site(first.is_there, first.pixel, sample, index, first.ray + on);
}

// A sample's position in its pixel, 0 to 1.
fn place_in_pixel(sample: u32) -> vec2f {
    return fract(dispatch.jitter + f32(sample) * dispatch.jitter_step);
}
