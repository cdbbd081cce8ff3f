// Counts the film's pixels by luminance, in equal steps of its logarithm. Luminances outside the bins
// count in the first or the last bin. The bins must be zero before the pass.
// uses: lib/film_mean, lib/lattice, lib/luminance, lib/mip, types/frame_uniforms, types/post

var<workgroup> own_bins: array<atomic<u32>, HISTOGRAM_BINS>;

fn bin(color: vec3f) -> u32 {
    let stops = log2(max(luminance(color), 1e-30)) - HISTOGRAM_LOW_STOPS;
    return u32(clamp(stops * HISTOGRAM_BINS_PER_STOP, 0.0, f32(HISTOGRAM_BINS) - 0.5));
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    // Workgroup memory starts as zeros.
    let levels = film_levels();
    let size = mip_size(levels, FIRST_MIP_LEVEL);
    let index = mip_index(workgroup.x, local_index);
    if (index < size.x * size.y) {
        let cell = vec2u(index % size.x, index / size.x);
        let span = mip_span(levels, FIRST_MIP_LEVEL, cell);
        let corner = mip_pixel(levels, FIRST_MIP_LEVEL, cell);
        for (var y = 0u; y < span.y; y++) {
            for (var x = 0u; x < span.x; x++) {
                let pixel = corner + vec2u(x, y);
                atomicAdd(&own_bins[bin(film_part(pixel_index(pixel)))], 1u);
            }
        }
    }
    workgroupBarrier();
    for (var i = local_index; i < HISTOGRAM_BINS; i += 64u) {
        let count = atomicLoad(&own_bins[i]);
        if (count > 0u) { atomicAdd(&statistics.bins[i], count); }
    }
}
