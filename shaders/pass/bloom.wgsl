// The light that blooms: the finest mip level of the light above the threshold, before or after the tone
// curve.
// uses: lib/curve, lib/exposure, lib/film_mean, lib/lattice, lib/luminance, lib/mip
// uses: types/frame_uniforms, types/post

// The part of a colour's light above the threshold; continuous at the threshold.
fn above_threshold(color: vec3f) -> vec3f {
    let l = luminance(color);
    return color * (max(l - frame.bloom.threshold, 0.0) / max(l, 1e-12));
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let levels = film_levels();
    let size = mip_size(levels, FIRST_MIP_LEVEL);
    let index = mip_index(workgroup.x, local_index);
    if (index >= size.x * size.y) { return; }
    let cell = vec2u(index % size.x, index / size.x);
    let span = mip_span(levels, FIRST_MIP_LEVEL, cell);
    let corner = mip_pixel(levels, FIRST_MIP_LEVEL, cell);
    let exposure = exposure_factor();
    var sum = vec3f(0.0);
    for (var y = 0u; y < span.y; y++) {
        for (var x = 0u; x < span.x; x++) {
            let pixel = corner + vec2u(x, y);
            var color = film_part(pixel_index(pixel)) * exposure;
            if (frame.bloom.after != 0u) { color = tone_mapped(color); }
            sum += above_threshold(color);
        }
    }
    mips[index] = vec4f(sum / f32(span.x * span.y), 0.0);
}
