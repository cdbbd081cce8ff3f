// The part of a picture that one dispatch computes. Host twin: `render::uniforms::Slice`.

struct Slice {
    // Lattice to pixel: see `lib/lattice.wgsl`.
    step: vec2u,
    offset: vec2u,
    stagger: u32,
    row_phase: u32,
    shift: u32,
    // Where in the grid the dispatch starts, counted in workgroups.
    first_workgroup: u32,
    // Columns and rows of workgroups in the lattice's grid, and the strides in which they are
    // visited: coprime to the counts, so that a slice is spread over the whole region.
    workgroups: vec2u,
    scatter: vec2u,
    // Position of the first sample inside its pixel, 0 to 1.
    jitter: vec2f,
    // 1: G-buffer records are packed in dispatch order; 0: one for each pixel of the region.
    compact: u32,
    // 1: add to the film; 0: replace what it holds.
    accumulate: u32,
    // The light that a shadow dispatch marches toward, as in `Light`: its bit and its reach here,
    // its vector and its kind below. One light a dispatch keeps an invocation's loops short.
    light_bit: u32,
    light_reach: f32,
    // The spacing of the lattice on the film, in pixels; 0 where it is complete.
    spacing: u32,
    // The mip level that a glow's pass reads, or starts from.
    mip_level: u32,
    // Direction of a blur: 0 along x, 1 along y.
    axis: u32,
    // Half the width of a blur's kernel, in elements of its mip level.
    half_width: f32,
    // How far exposure moves toward its goal, 0 to 1.
    adapt: f32,
    // The lattice level that indirect light's neighbours are taken from.
    neighbour_level: u32,
    light_vector: vec3f,
    light_kind: u32,
    // Blocks of a dispatch that goes through all of them: see `types/work_queues.wgsl`.
    blocks: u32,
    // The ray queue that a dispatch writes or reads.
    ray_queue: u32,
    // How many samples of a pixel are computed together, and the logarithm to base two of the
    // threads that they have.
    samples: u32,
    samples_shift: u32,
    // From each of them to the next, round the pixel.
    jitter_step: vec2f,
    unused: vec2u,
}

const LIGHT_POINT = 1u;

@group(0) @binding(2) var<uniform> slice: Slice;
