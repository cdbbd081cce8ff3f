// Film statistics and mip levels. Host twin: `render::post`.

const HISTOGRAM_BINS = 128u;
const HISTOGRAM_LOW_STOPS = -14.0;
const HISTOGRAM_BINS_PER_STOP = 5.0;

struct Statistics {
    // Size of one eye's part of the film below the mip levels, in pixels.
    eye_px: vec2u,
    // The mip level that holds the bloom, and the index of its first element.
    bloom_level: u32,
    bloom_start: u32,
    // The film's mean colour.
    mean: vec3f,
    // The mean of log2(luminance + LOG_OFFSET).
    mean_log2: f32,
    // Auto exposure, in stops.
    adapted_stops: f32,
    // Number of pixels by log2 of their luminance.
    bins: array<atomic<u32>, HISTOGRAM_BINS>,
}

@group(1) @binding(0) var<storage, read_write> statistics: Statistics;
// The film's mip levels from FIRST_MIP_LEVEL on, finest first, rows packed.
@group(1) @binding(1) var<storage, read_write> mips: array<vec4f>;
// The result of a blur's first direction; as large as the finest level.
@group(1) @binding(2) var<storage, read_write> half_blurred: array<vec4f>;
