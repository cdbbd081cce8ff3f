// Computes how far all rays of a block toward the dispatch's light are unblocked. Queues the blocks that face
// the light for shadow rays. Clears every point's bit; a shadow ray sets it if the light reaches the point.
// uses: formula, lib/cone, lib/estimate_next, lib/lattice, lib/shadow, lib/sphere
// uses: types/dispatch_params, types/enqueue, types/frame_uniforms, types/gbuffer
// uses: types/work_queues

var<private> points: array<vec4f, BLOCK_THREADS>;

// Position along the light's direction of the plane that rays to all points reach unblocked. Points with
// w = 0 do not count; w is a point's hit distance.
fn clear_plane(fractal: Fractal) -> f32 {
    let direction = dispatch.light_vector;
    var low = vec3f(1e30);
    var high = vec3f(-1e30);
    var surface_distance = 0.0;
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        if (points[i].w == 0.0) { continue; }
        low = min(low, points[i].xyz);
        high = max(high, points[i].xyz);
        surface_distance = max(surface_distance, points[i].w);
    }
    let center = 0.5 * (low + high);
    var width = 0.0;
    var extent = 0.0;
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        if (points[i].w == 0.0) { continue; }
        let offset = points[i].xyz - center;
        let along = dot(offset, direction);
        width = max(width, length(offset - along * direction));
        extent = max(extent, along);
    }
    // Starts where the last of the rays leaves the bounding sphere, or at the end of the light's reach.
    let height = dot(center, direction);
    let leaves = bounding_exit(center, direction, width);
    let part = frame.march.ball_part;
    var s = min(leaves, dispatch.light_reach + extent);
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < CONE_STEPS; i++) {
            let ahead = estimate_next(&pending, fractal, center + s * direction, cone_direction());
            if (pending.is_needed) { break; }
            // No point is farther than this from the plane at `s`.
            let blocks = blocking_distance(s + extent, surface_distance);
            let ball = min(part * ahead.step, MAX_BALL) - blocks;
            let advance = sqrt(max(ball * ball - width * width, 0.0));
            if (ball <= width || advance <= width) { break; }
            s -= advance;
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, center + s * direction, cone_direction());
    }
    return height + s;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    if (thread.x >= atomicLoad(&work_queues.hits)) { return; }
    let block = block_at(work_queues.entries[thread.x]);
    var any_faces = false;
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        points[i] = vec4f(0.0);
        let site = block_site(block, i);
        if (!site.is_there) { continue; }
        let seen = receiver(site);
        visibility[site.index][light_word()] &= ~light_mask();
        if (!seen.faces) { continue; }
        any_faces = true;
        points[i] = vec4f(seen.point, seen.surface_distance);
    }
    if (!any_faces) { return; }
    var clear = 1e30;
    if (has_parallel_rays()) { clear = clear_plane(frame.formula.fractal); }
    enqueue_ray(block.index, clear);
}
