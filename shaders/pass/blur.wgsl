// One direction of a uniform kernel over a mip level (thesis 4.5): along x from the level to
// `half_blurred`, along y back. The kernel's width is exact, not rounded to whole elements: the elements
// at its ends are weighted by the part that it covers. The kernel is normalised by the pixels inside
// the eye's part of the film, so that borders do not darken and no light reaches the other eye.
// uses: lib/mip, types/dispatch_params, types/frame_uniforms, types/post

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let level = dispatch.mip_level;
    let levels = film_levels();
    let size = mip_size(levels, level);
    let start = mip_start(levels, level);
    let index = mip_index(workgroup.x, local_index);
    if (index >= size.x * size.y) { return; }
    let along = dispatch.axis;
    let cell = vec2u(index % size.x, index / size.x);
    let stride = select(1u, size.x, along == 1u);
    let middle = i32(cell[along]);
    let reach = i32(ceil(dispatch.half_width - 0.5));
    let own_size = mip_eye_size(levels, level);
    let own = i32(cell[along] % own_size[along]);
    let ahead = i32(own_size[along]) - 1 - own;
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var i = max(-reach, -own); i <= min(reach, ahead); i++) {
        var other = cell;
        other[along] = u32(middle + i);
        let covered = clamp(dispatch.half_width + 0.5 - f32(abs(i)), 0.0, 1.0);
        let weight = covered * f32(mip_span(levels, level, other)[along]);
        let at = u32(i32(index) + i * i32(stride));
        if (along == 0u) {
            sum += weight * mips[start + at].rgb;
        } else {
            sum += weight * half_blurred[at].rgb;
        }
        total += weight;
    }
    let mean = vec4f(sum / total, 0.0);
    if (along == 0u) {
        half_blurred[index] = mean;
    } else {
        mips[start + index] = mean;
        if (index == 0u) {
            statistics.bloom_level = level;
            statistics.bloom_start = start;
        }
    }
}
