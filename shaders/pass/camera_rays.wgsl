// Makes the camera ray of each sample, from the eye, or from the surface point if its depth is known.
// uses: lib/camera, lib/lattice, types/dispatch_params, types/frame_uniforms, types/gbuffer
// uses: types/ray

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    if (thread.x / BLOCK_THREADS >= dispatch.blocks) { return; }
    let site = block_site(block_at(thread.x / BLOCK_THREADS), thread.x % BLOCK_THREADS);
    if (!site.is_there) { return; }
    var ray = camera_ray(site);
    if (dispatch.starts_at_surface != 0u) { ray = advanced(ray, bitcast<f32>(surface[site.index].x)); }
    rays[site.ray] = ray;
}
