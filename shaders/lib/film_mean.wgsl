// Mean radiance of a pixel. Path tracing fades in over the direct picture, since few paths are noisy.
// uses: lib/shared_exponent, types/direct, types/film, types/frame_uniforms

// The mean of a pixel's samples.
fn sample_mean(index: u32) -> vec3f {
    let bw = film_bw[index];
    return vec3f(film_rg[index], bw.x) / select(bw.y, 1.0, bw.y == 0.0);
}

fn film_mean(index: u32) -> vec3f {
    let mean = sample_mean(index);
    let count = film_bw[index].y;
    // A single sample is of the direct picture itself.
    if (count <= 1.0 || count >= frame.paths.preview_samples) { return mean; }
    return mix(shared_exponent_unpack(direct[index]), mean, count / frame.paths.preview_samples);
}

// A pixel's contribution to a sum over many pixels. NaN, negative and infinite values count as 0: one NaN
// would spoil the whole sum.
fn film_part(index: u32) -> vec3f {
    let color = film_mean(index);
    return select(vec3f(0.0), color, (color >= vec3f(0.0)) & (color < vec3f(1e30)));
}
