// Computes how far all rays of a block go before any of them may hit. Queues the blocks with rays that
// may hit; the samples of the other blocks miss. Skips pixels that get no more samples.
// uses: lib/camera, lib/cone, lib/eye, lib/lattice, lib/lens, lib/sphere, types/dispatch_params
// uses: types/enqueue, types/frame_uniforms, types/gbuffer, types/converged_pixels

// The depth that all rays of a block may go to; negative if all of them miss.
fn clear_block(fractal: Fractal, block: Block) -> f32 {
    let box = block_box(block);
    // Rays through a lens start at different places: no cone holds them.
    if (sees_through_lens() || is_second_eye(box.first) != is_second_eye(box.last)) { return 0.0; }
    let side = eye_side(box.first);
    let size = vec2f(box.last - box.first + vec2u(1u));
    let middle = eye_ray(eye_position(box.first, 0.5 * size), side);
    var spread = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let corner = eye_ray(eye_position(box.first, size * vec2f(vec2u(i & 1u, i >> 1u))), side);
        spread = max(spread, distance(corner.direction, middle.direction));
    }
    let entry = bounding_entry(middle.origin, middle.direction, spread);
    if (entry < 0.0) { return -1.0; }
    if (has_section_bands() || has_cloud()) { return entry; }
    // Its rays find out where they come within the colour distance.
    let cone = max(frame.camera.hit_cone, frame.camera.color_cone);
    return clear_cone(fractal, middle.origin, middle.direction, spread, entry, cone);
}

// Whether paths meet a medium around the set.
fn has_cloud() -> bool {
    return frame.medium.kind == MEDIUM_ITERATIONS && is_jittered();
}

// Whether a block's samples are of one pixel, which gets no more.
fn is_converged(block: Block) -> bool {
    // The first round replaces the film: until then moments are those of an older picture.
    if (frame.paths.noise <= 0.0 || dispatch.accumulate == 0u) { return false; }
    if (dispatch.compact == 0u || dispatch.samples_shift != 3u) { return false; }
    let pixel = pixel_at(block.corner);
    return inside_region(pixel) && moments[pixel_index(pixel)] < 0.0;
}

// Whether the dispatch computes any sample of a block.
fn has_work(block: Block) -> bool {
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        if (block_site(block, i).is_there) { return true; }
    }
    return false;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    if (thread.x >= dispatch.blocks) { return; }
    let block = block_at(thread.x);
    if (!has_work(block)) { return; }
    if (is_converged(block)) {
        for (var i = 0u; i < BLOCK_THREADS; i++) { surface[block_site(block, i).index].x = SKIPPED; }
        return;
    }
    let clear = clear_block(frame.formula.fractal, block);
    if (clear >= 0.0) {
        enqueue_ray(block.index, clear);
        return;
    }
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        let site = block_site(block, i);
        if (site.is_there) { surface[site.index].x = 0u; }
    }
}
