// What the passes after light paths need: the paths of a batch, one per sample, and the noise of pixels.
// uses: types/path

@group(1) @binding(0) var<storage, read> paths: array<PathState>;
// For each pixel the sum over its rounds of samples of their number of samples times their squared mean luminance; negative once
// the pixel has too little noise for more samples.
@group(1) @binding(1) var<storage, read_write> moments: array<f32>;
struct PathCounts {
    // Number of pixels with too much noise.
    noisy_pixels: atomic<u32>,
    // Luminance of all paths before the firefly limit, and what the limit took away, both in firefly limits over
    // `LIGHT_STEPS`. Neither counts on once the first is large.
    light: atomic<u32>,
    clamped: atomic<u32>,
}

@group(1) @binding(2) var<storage, read_write> path_counts: PathCounts;
// The guides of the denoiser, one element a pixel; in place of the visibility of centre samples.
@group(1) @binding(3) var<storage, read_write> guides: array<vec2u>;
