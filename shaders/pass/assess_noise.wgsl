// Decides which pixels get no more samples: those that have as little noise as asked for, with all their neighbours.
// A pixel's error is the standard error of its mean, estimated from the means of its rounds.
// uses: lib/film_mean, lib/lattice, lib/luminance, lib/standard_error, types/dispatch_params, types/film
// uses: types/frame_uniforms, types/traced_paths

// Added to a pixel's value, over the display's white: errors of dark pixels are seen less.
const DARK = 0.1;

// The standard error of a pixel, relative to its value on the display; large where too few samples tell.
fn relative_error(pixel: vec2u) -> f32 {
    let index = pixel_index(pixel);
    if (has_few_rounds(index)) { return 1e30; }
    let exposure = frame.tone.exposure;
    let error = sqrt(squared_standard_error(index, moments[index]));
    return exposure * error / (exposure * luminance(sample_mean(index)) + DARK);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    let low = max(pixel, vec2u(1u)) - 1u;
    let high = min(pixel + 1u, frame.size_px - 1u);
    var error = 0.0;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) { error = max(error, relative_error(vec2u(x, y))); }
    }
    let index = pixel_index(pixel);
    // Only the sign changes: neighbours read the magnitude meanwhile.
    let magnitude = max(abs(moments[index]), 1e-30);
    let is_noisy = error > frame.paths.noise;
    moments[index] = select(-magnitude, magnitude, is_noisy);
    if (is_noisy) { atomicAdd(&path_counts.noisy_pixels, 1u); }
}
