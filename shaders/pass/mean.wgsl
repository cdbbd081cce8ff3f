// The finest mip level of the film: mean colour, and mean logarithm of the luminance.
// uses: lib/film_mean, lib/lattice, lib/luminance, lib/mip, types/frame_uniforms, types/post

// Keeps the logarithm of black finite (the delta of Reinhard et al. 2002, eq. 1).
const LOG_OFFSET = 1e-4;

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
    var sum = vec4f(0.0);
    for (var y = 0u; y < span.y; y++) {
        for (var x = 0u; x < span.x; x++) {
            let pixel = corner + vec2u(x, y);
            let color = film_part(pixel_index(pixel));
            sum += vec4f(color, log2(max(luminance(color), 0.0) + LOG_OFFSET));
        }
    }
    mips[index] = sum / f32(span.x * span.y);
}
