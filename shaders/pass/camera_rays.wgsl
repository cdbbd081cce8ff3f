// Makes the camera ray of each sample: the only pass that derives a ray from its pixel.
// uses: lib/camera, lib/eye, lib/lattice, types/frame_uniforms, types/gbuffer, types/ray, types/slice

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    frame = frame_uniforms;
    if (thread.x / BLOCK_THREADS >= slice.blocks) { return; }
    let site = block_site(block_at(thread.x / BLOCK_THREADS), thread.x % BLOCK_THREADS);
    if (!site.is_there) { return; }
    var ray = eye_ray(eye_position(site.pixel, place_in_pixel(site.sample)), eye_side(site.pixel));
    if (slice.starts_at_surface != 0u) { ray = advanced(ray, bitcast<f32>(surface[site.index].x)); }
    rays[site.ray] = ray;
}
