//! The parameters of one dispatch, as WGSL has them in `shaders/types/dispatch_params.wgsl`.

use crate::gpu::host_shared::host_shared;

host_shared! {
    /// Name, size in bytes and fields of the struct here.
    OF_DISPATCHES;
    /// The parameters of one dispatch.
    DispatchParams {
        /// Lattice positions per grid position.
        step: [u32; 2],
        /// Offset of the first lattice position.
        offset: [u32; 2],
        /// Offset in x of every other row.
        stagger: u32,
        /// 0 or 1: which rows are staggered.
        row_phase: u32,
        /// log2 of the spacing of lattice positions, in pixels.
        shift: u32,
        /// First workgroup of the dispatch.
        first_workgroup: u32,
        /// Columns and rows of workgroups in the grid.
        workgroups: [u32; 2],
        /// Strides in which columns and rows are visited.
        scatter: [u32; 2],
        /// The upper left one of the pixels that the dispatch leaves as they are.
        kept_first: [u32; 2],
        /// One past the lower right one of these pixels.
        kept_end: [u32; 2],
        /// Position of the first sample in its pixel, 0 to 1.
        jitter: [f32; 2],
        /// 1: G-buffer records are packed in dispatch order.
        compact: u32,
        /// 1: adds to the film; 0: replaces its value.
        accumulate: u32,
        /// The visibility bit of a shadow dispatch's light, 0 to 63.
        light_bit: u32,
        /// Greatest distance of a blocker from the point, in render space.
        light_reach: f32,
        /// Spacing of a sparse lattice on the film, in pixels; 0 for a complete film.
        spacing: u32,
        /// Mip level that a post pass reads, or starts from.
        mip_level: u32,
        /// Direction of a blur: 0 along x, 1 along y.
        axis: u32,
        /// Half width of a blur's kernel, in elements of the mip level.
        half_width: f32,
        /// The part of the way to its goal that exposure moves, 0 to 1.
        adapt: f32,
        /// The lattice level of the neighbours for indirect light.
        neighbour_level: u32,
        /// Direction toward a shadow dispatch's light, or its position; render space.
        light_vector: [f32; 3],
        /// 0 environment, 1 point.
        light_kind: u32,
        /// Number of blocks of a dispatch over all blocks.
        blocks: u32,
        /// First block of the dispatch in its first workgroup, 0 to 7.
        first_block: u32,
        /// Threads of each workgroup over a queue that compute a sample: a power of two; 64, which is all, on a GPU.
        queue_threads: u32,
        /// The ray queue that a dispatch writes or reads.
        ray_queue: u32,
        /// Number of samples of a pixel that are computed together.
        samples: u32,
        /// log2 of the number of threads per pixel.
        samples_shift: u32,
        /// Offset from each of these samples to the next, modulo 1.
        jitter_step: [f32; 2],
        /// 1: depths are there, and rays start at their surface points; 0: rays start at the eye.
        starts_at_surface: u32,
        /// The size of a shadow dispatch's light, as in [`Light`](super::Light).
        light_size: f32,
        /// The seed of a shadow dispatch's light, as in [`Light`](super::Light).
        light_seed: u32,
        /// Number of the first sample among a pixel's jittered samples.
        first_sample: u32,
        /// Number of times that the rays' paths have been scattered; 0 for camera rays.
        bounce: u32,
        /// Region of the queue's entries: 0 blocks, 1 and 2 samples with rays, 3 samples with shadow rays.
        queue_region: u32,
        /// Number of a pass that is repeated: the denoiser's iteration, or a sub-frame.
        iteration: u32,
        /// 1: the display shows the denoised film.
        denoised: u32,
        /// First row of workgroups of a dispatch over rows of pixels.
        first_row: u32,
    }
}
