// The samples of a sparse lattice to display values, before they are spread over the picture. For
// one eye, without exposure of its own and without bloom.

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    frame = frame_uniforms;
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let color = tone_mapped(film_mean(pixel_index(pixel)) * frame.tone.exposure);
    developed[developed_index(pixel >> vec2u(slice.shift))] = developed_pack(srgb_from_linear(color));
}
