// A mip level from the next finer one, `slice.mip_level`: each element is the mean of the two by
// two below it, weighted by the pixels that those are made of, so that odd sizes count right.

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    let level = slice.mip_level;
    let finer_size = mip_size(picture.size_px, level);
    let size = mip_size(picture.size_px, level + 1u);
    let index = mip_index(workgroup.x, local_index);
    if (index >= size.x * size.y) { return; }
    let cell = vec2u(index % size.x, index / size.x);
    let start = mip_start(picture.size_px, level);
    var sum = vec4f(0.0);
    var pixels = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let finer = 2u * cell + vec2u(i & 1u, i >> 1u);
        if (any(finer >= finer_size)) { continue; }
        let span = mip_span(picture.size_px, level, finer);
        let weight = f32(span.x) * f32(span.y);
        sum += weight * mips[start + finer.y * finer_size.x + finer.x];
        pixels += weight;
    }
    mips[start + finer_size.x * finer_size.y + index] = sum / pixels;
}
