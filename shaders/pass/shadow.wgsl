// The visibility bit of the slice's light: does it reach the sample's point? The bits of others stay.
// Rays run inward, from where the light enters the bounding sphere to the point (thesis 4.5):
// their long steps come first.

// No step is shorter than this part of the distance that blocks.
const LEAST_STEP = 0.25;

// At power 2 steps of two hit distances may pass what would block, for most of it is hairs; at 3 of half a one.
fn least_step(fractal: Fractal, blocks: f32, surface_distance: f32) -> f32 {
    let low = clamp(5.0 - 1.5 * fractal.power, 0.0, 2.0);
    return max(LEAST_STEP * blocks, low * surface_distance);
}

// `clear`: as far before the point a ray is known not to be blocked.
fn light_reaches(fractal: Fractal, point: vec3f, surface_distance: f32, clear: f32) -> bool {
    var direction = slice.light_vector;
    var farthest = slice.light_reach;
    if (slice.light_kind == LIGHT_POINT) {
        let to_light = slice.light_vector - point;
        farthest = min(farthest, length(to_light));
        direction = to_light / max(length(to_light), 1e-30);
    }
    var s = min(min(farthest, clear), bounding_interval(point, direction).y);
    var over = over_relaxation(fractal.power);
    let checks_hits = needs_hit_check(fractal);
    var looks = 0u;
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < fractal.shadow_steps; i++) {
            var ahead = Estimate(0.0, 0.0);
            let is_looking = checks_hits && looks > 0u;
            if (s > surface_distance || is_looking) {
                ahead = estimate_next(&pending, fractal, point + s * direction, direction);
            }
            if (pending.is_needed) { break; }
            ahead.step = max(ahead.step, step_escalation(i, fractal.shadow_steps) * ahead.distance);
            if (!is_looking) {
                let back = step_back(&over, ahead.step);
                s += back;
                // Where a step too long is taken back, what is left may be known to be empty.
                if (s <= surface_distance) { return true; }
                if (back > 0.0) { continue; }
            }
            let blocks = blocking_distance(fractal, s, surface_distance);
            if (ahead.distance < blocks) {
                // A dip has to last, as for a camera ray.
                if (!checks_hits || looks == THICK_PLACES) { return false; }
                looks++;
                s -= THICK / f32(THICK_PLACES) * surface_distance;
                continue;
            }
            looks = 0u;
            s -= next_step(&over, max(ahead.step, least_step(fractal, blocks, surface_distance)));
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, point + s * direction, direction);
    }
    return true;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    frame = frame_uniforms;
    let queued = queued_ray(thread.x);
    let site = queued.site;
    if (!site.is_there) { return; }
    let seen = receiver(site);
    if (!seen.faces) { return; }
    var clear = 1e30;
    if (slice.light_kind != LIGHT_POINT) { clear = queued.clear - dot(seen.point, slice.light_vector); }
    if (light_reaches(frame.fractal, seen.point, seen.surface_distance, clear)) {
        visibility[site.index][light_word()] |= light_mask();
    }
}
