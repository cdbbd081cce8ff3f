// How far all rays of a block to the slice's light go unblocked, and which blocks face it: these
// are queued for shadow rays. Every point is dark until one of those finds it lit.

var<private> points: array<vec4f, BLOCK_THREADS>;

// Of the points with w > 0, their hit distances: how far along the light's direction the plane lies that
// rays to all of them come to unblocked.
fn clear_plane(fractal: Fractal) -> f32 {
    let direction = slice.light_vector;
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
    // Where the last of the rays leaves the bounding sphere, or where shadows end.
    let height = dot(center, direction);
    let leaves = bounding_exit(center, direction, width);
    let part = ball_part(fractal.power);
    var s = min(leaves, slice.light_reach + extent);
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < BUNDLE_STEPS; i++) {
            let ahead = estimate_next(&pending, fractal, center + s * direction, frame.series.widest);
            if (pending.is_needed) { break; }
            // No point is farther than this from the plane through `s`.
            let blocks = blocking_distance(fractal, s + extent, surface_distance);
            let ball = min(part * ahead.step, MOST_BALL) - blocks;
            let advance = sqrt(max(ball * ball - width * width, 0.0));
            if (ball <= width || advance <= width) { break; }
            s -= advance;
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, center + s * direction, frame.series.widest);
    }
    return height + s;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    frame = frame_uniforms;
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
    if (slice.light_kind != LIGHT_POINT) { clear = clear_plane(frame.fractal); }
    enqueue_ray(block.index, clear);
}
