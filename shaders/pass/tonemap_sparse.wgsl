// Tone maps the samples of a sparse lattice to display values, before they are upsampled. Only for
// one eye, without auto exposure and without bloom.
// uses: lib/curve, lib/film_mean, lib/lattice, lib/srgb, types/dispatch_params, types/frame_uniforms
// uses: types/tonemap_sparse

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let color = tone_mapped(film_mean(pixel_index(pixel)) * frame.tone.exposure);
    sparse_display[sparse_index(pixel >> vec2u(dispatch.shift))] = display_pack(srgb_from_linear(color));
}
