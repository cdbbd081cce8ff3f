// Counts the hits of a lattice by the values that select their colours. The bins must be zero before the pass.
// uses: lib/color_value, lib/lattice, types/frame_uniforms, types/gbuffer

const COLOR_BINS = 1024u;

// The bins of the first layer, then those of the second.
@group(2) @binding(0) var<storage, read_write> color_bins: array<atomic<u32>, 2u * COLOR_BINS>;

fn count_value(layer: ColorLayer, first_bin: u32, stored: f32, normal: u32) {
    let place = max(color_value(layer, stored, normal) / layer.greatest, 0.0) * f32(COLOR_BINS);
    atomicAdd(&color_bins[first_bin + min(u32(place), COLOR_BINS - 1u)], 1u);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let index = pixel_index(pixel);
    let hit = surface[index];
    if (hit.x == 0u) { return; }
    let stored = color_data[index];
    if (stored.y == ON_SECTION) { return; }
    count_value(frame.first_layer, 0u, stored.x, hit.y);
    count_value(frame.second_layer, COLOR_BINS, stored.y, hit.y);
}
