// The parameters of one dispatch. Host twin: `render::uniforms::DispatchParams`.

struct DispatchParams {
    // Lattice to pixel: see `lib/lattice.wgsl`.
    step: vec2u,
    offset: vec2u,
    stagger: u32,
    row_phase: u32,
    shift: u32,
    // First workgroup of the dispatch in the lattice's grid.
    first_workgroup: u32,
    // Columns and rows of workgroups in the lattice's grid, and the strides in which they are
    // visited: coprime to the counts, so that a dispatch spreads over the whole region.
    workgroups: vec2u,
    scatter: vec2u,
    // Pixels that the dispatch leaves as they are: from the first to before the end.
    kept_first: vec2u,
    kept_end: vec2u,
    // Position of the first sample inside its pixel, 0 to 1.
    jitter: vec2f,
    // 1: G-buffer records are packed in dispatch order; 0: one record per pixel of the region.
    compact: u32,
    // 1: add to the film; 0: replace what it holds.
    accumulate: u32,
    // The light of a shadow dispatch, as in `Light`: its bit and reach here, its vector and kind below.
    // One light per dispatch keeps an invocation's loops short.
    light_bit: u32,
    light_reach: f32,
    // Spacing of a sparse lattice on the film, in pixels; 0 for a complete film.
    spacing: u32,
    // The mip level that a post pass reads, or starts from.
    mip_level: u32,
    // Direction of a blur: 0 along x, 1 along y.
    axis: u32,
    // Half width of a blur's kernel, in elements of its mip level.
    half_width: f32,
    // The part of the way to its goal that exposure moves, 0 to 1.
    adapt: f32,
    // The lattice level of the neighbours for indirect light.
    neighbour_level: u32,
    light_vector: vec3f,
    light_kind: u32,
    // Number of blocks of a dispatch over all blocks: see `types/work_queues.wgsl`.
    blocks: u32,
    // First block of the dispatch in its first workgroup, 0 to 7.
    first_block: u32,
    // Threads of each workgroup over a queue that compute a sample: a power of two, and 64, which is all, on a GPU. Few samples
    // then occupy all cores of a CPU adapter.
    queue_threads: u32,
    // The ray queue that a dispatch writes or reads.
    ray_queue: u32,
    // Number of samples of a pixel that are computed together, and log2 of the number of threads per
    // pixel.
    samples: u32,
    samples_shift: u32,
    // Offset from each of these samples to the next, modulo 1.
    jitter_step: vec2f,
    // 1: depths are there, and rays start at their surface points; 0: rays start at the eye.
    starts_at_surface: u32,
    // The size and the seed of a shadow dispatch's light, as in `Light`.
    light_size: f32,
    light_seed: u32,
    // Number of the first sample among a pixel's jittered samples.
    first_sample: u32,
    // Number of times that the rays' paths have been scattered; 0 for camera rays.
    bounce: u32,
    // Region of the entries of the dispatch's ray queue: see `types/work_queues.wgsl`.
    queue_region: u32,
    // Number of a pass that is repeated: the denoiser's iteration, or a sub-frame.
    iteration: u32,
    // 1: the display shows the denoised film.
    denoised: u32,
    // First row of workgroups of a dispatch over rows of pixels.
    first_row: u32,
}

const LIGHT_POINT = 1u;

@group(0) @binding(2) var<uniform> dispatch: DispatchParams;
