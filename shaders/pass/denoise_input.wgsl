// The input of the denoiser: each pixel's light over its albedo, and the standard error of that light.
// uses: lib/eye, lib/film_mean, lib/lattice, lib/luminance, lib/shared_exponent, lib/standard_error
// uses: types/denoise_input, types/dispatch_params, types/film, types/frame_uniforms, types/guides

// Rounds of one Sobol sequence are no independent numbers: errors fall with the power -0.6 of the samples, not -0.5.
const SOBOL_GAIN = -0.1;

// Light over albedo.
fn demodulated(index: u32) -> vec3f {
    return film_mean(index) / demodulator(unpack_guides(guides[index]).albedo);
}

// Squared error of a pixel's luminance over that of its albedo.
fn squared_error(index: u32) -> f32 {
    let count = film_bw[index].y;
    let albedo = luminance(demodulator(unpack_guides(guides[index]).albedo));
    // A part of the picture may still be that of direct light.
    let part = min(count / max(frame.paths.preview_samples, 1.0), 1.0) * pow(count, SOBOL_GAIN) / albedo;
    return part * part * squared_standard_error(index, moments[index]);
}

// The error by the mean of the squared errors about a pixel, since a single one is as noisy as the pixel; at least the
// pixel's own, for pixels that few paths make bright. Negative if a pixel there has too few rounds.
fn error_of(pixel: vec2u) -> f32 {
    var sum = 0.0;
    var total = 0.0;
    let low = max(pixel, vec2u(1u)) - 1u;
    let high = min(pixel + 1u, frame.size_px - 1u);
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            if (is_second_eye(vec2u(x, y)) != is_second_eye(pixel)) { continue; }
            let off = abs(vec2i(vec2u(x, y)) - vec2i(pixel));
            let weight = f32((2 - off.x) * (2 - off.y));
            let index = pixel_index(vec2u(x, y));
            if (has_few_rounds(index)) { return -1.0; }
            sum += weight * squared_error(index);
            total += weight;
        }
    }
    return sqrt(max(sum / total, squared_error(pixel_index(pixel))));
}

// The standard deviation of the light about a pixel, for pixels with few samples.
fn local_deviation(pixel: vec2u) -> f32 {
    let own = unpack_guides(guides[pixel_index(pixel)]).normal;
    let low = max(pixel, vec2u(2u)) - 2u;
    let high = min(pixel + 2u, frame.size_px - 1u);
    var sum = vec3f(0.0);
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            if (is_second_eye(vec2u(x, y)) != is_second_eye(pixel)) { continue; }
            let index = pixel_index(vec2u(x, y));
            let off = unpack_guides(guides[index]).normal - own;
            let weight = exp(-4.0 * dot(off, off));
            let light = luminance(demodulated(index));
            sum += weight * vec3f(1.0, light, light * light);
        }
    }
    let mean = sum.y / sum.x;
    return sqrt(max(sum.z / sum.x - mean * mean, 0.0));
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    let index = pixel_index(pixel);
    var error = error_of(pixel);
    if (error < 0.0) { error = local_deviation(pixel); }
    light[index] = shared_exponent_pack(demodulated(index));
    var known = unpack_guides(guides[index]);
    known.error = error;
    guides[index] = pack_guides(known);
}
