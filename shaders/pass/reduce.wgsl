// Computes a mip level from the next finer one, `dispatch.mip_level`: each element is the mean of the two by
// two elements below it, weighted by their pixel counts, so that odd sizes are exact.
// uses: lib/mip, types/dispatch_params, types/frame_uniforms, types/post

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let level = dispatch.mip_level;
    let levels = film_levels();
    let finer_size = mip_size(levels, level);
    let size = mip_size(levels, level + 1u);
    let index = mip_index(workgroup.x, local_index);
    if (index >= size.x * size.y) { return; }
    let cell = vec2u(index % size.x, index / size.x);
    let start = mip_start(levels, level);
    let own_size = mip_eye_size(levels, level + 1u);
    let own_finer_size = mip_eye_size(levels, level);
    let eye = cell / own_size;
    var sum = vec4f(0.0);
    var pixels = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let own = 2u * (cell % own_size) + vec2u(i & 1u, i >> 1u);
        if (any(own >= own_finer_size)) { continue; }
        let finer = eye * own_finer_size + own;
        let span = mip_span(levels, level, finer);
        let weight = f32(span.x) * f32(span.y);
        sum += weight * mips[start + finer.y * finer_size.x + finer.x];
        pixels += weight;
    }
    mips[start + finer_size.x * finer_size.y + index] = sum / pixels;
}
