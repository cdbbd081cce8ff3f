// Film statistics and mip levels. Host twin: `render::post`.

const HISTOGRAM_BINS = 128u;
const HISTOGRAM_LOW_STOPS = -14.0;
const HISTOGRAM_BINS_PER_STOP = 5.0;

struct Statistics {
    // One eye's part of what the mip levels are made of, in pixels.
    eye_px: vec2u,
    // The mip level that holds the bloom, and its first element.
    bloom_level: u32,
    bloom_start: u32,
    // The film's mean colour.
    mean: vec3f,
    // The mean of log2(luminance + LOG_OFFSET).
    mean_log2: f32,
    // Auto exposure, stops.
    adapted_stops: f32,
    unused_a: u32,
    unused_b: u32,
    unused_c: u32,
    // Pixels by log2 of their luminance.
    bins: array<atomic<u32>, HISTOGRAM_BINS>,
}

@group(1) @binding(0) var<storage, read_write> statistics: Statistics;
// The film's mip levels from FIRST_MIP_LEVEL on, the finest first, rows packed.
@group(1) @binding(1) var<storage, read_write> mips: array<vec4f>;
// As large as the finest level: between the two directions of a blur.
@group(1) @binding(2) var<storage, read_write> half_blurred: array<vec4f>;
