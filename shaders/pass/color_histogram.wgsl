// Counts the hits of a lattice by the value that selects their colour. The bins must be zero before the pass.
// uses: lib/color_value, lib/lattice, types/frame_uniforms, types/gbuffer

const COLOR_BINS = 1024u;

@group(2) @binding(0) var<storage, read_write> color_bins: array<atomic<u32>, COLOR_BINS>;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    frame = frame_uniforms;
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let index = pixel_index(pixel);
    if (surface[index].x == 0u) { return; }
    let place = color_value(color_data[index]) * f32(COLOR_BINS);
    atomicAdd(&color_bins[min(u32(place), COLOR_BINS - 1u)], 1u);
}
