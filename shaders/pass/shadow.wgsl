// Sets the visibility bit of the dispatch's light if the light reaches the sample's point; keeps other bits. For paths,
// adds the chosen light's light.
// Rays run inward, from where the light enters the bounding sphere to the point (thesis 4.5):
// their long steps come first.
// uses: formula, lib/estimate_next, lib/over_relaxation, lib/shadow, lib/sphere
// uses: types/dispatch_params, types/frame_uniforms, types/gbuffer, types/paths, types/work_queues

// Least step, over the blocking distance.
const MIN_STEP = 0.25;

fn min_step(blocks: f32, surface_distance: f32) -> f32 {
    return max(MIN_STEP * blocks, frame.march.shadow_min_step * surface_distance);
}

// `clear`: the distance before the point up to which the ray is known to be clear.
fn light_reaches(fractal: Fractal, seen: Receiver, clear: f32) -> bool {
    let point = seen.point;
    let surface_distance = seen.surface_distance;
    let direction = seen.light.toward;
    let farthest = min(dispatch.light_reach, seen.light.distance);
    var s = min(min(farthest, clear), bounding_interval(point, direction, frame.march.bounding_radius).y);
    var over = over_relaxation();
    let checks_hits = needs_hit_check();
    var looks = 0u;
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < frame.march.shadow_steps; i++) {
            var ahead = Estimate(0.0, 0.0);
            let is_looking = checks_hits && looks > 0u;
            if (s > surface_distance || is_looking) {
                ahead = estimate_next(&pending, fractal, point + s * direction, direction);
            }
            if (pending.is_needed) { break; }
            ahead.step = empty_ball(over, ahead, i, frame.march.shadow_steps);
            if (!is_looking) {
                let back = step_back(&over, ahead.step);
                s += back;
                // A step that is taken back may already have proved the rest of the ray empty.
                if (s <= surface_distance) { return true; }
                if (back > 0.0) { continue; }
            }
            let blocks = blocking_distance(s, surface_distance);
            if (ahead.distance < blocks) {
                // A blocker must last, at all points that a hit is checked at.
                if (!checks_hits || looks == THICKNESS_CHECKS) { return false; }
                looks++;
                s -= CHECKED_THICKNESS / f32(THICKNESS_CHECKS) * surface_distance;
                continue;
            }
            looks = 0u;
            s -= next_step(&over, max(ahead.step, min_step(blocks, surface_distance)));
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, point + s * direction, direction);
    }
    return true;
}

// The vertex of a path as the target of its chosen light's ray.
fn path_receiver(site: Site) -> Receiver {
    let path = paths[site.ray];
    let ray = rays[site.ray];
    let light = LightSample(path.nee_direction, path.nee_distance, 1.0);
    return Receiver(ray.origin, ray.radius / frame.march.shadow_margin, true, light);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let queued = queued_ray(thread.x);
    let site = queued.site;
    if (!site.is_there) { return; }
    let is_path = is_path_queue();
    var seen: Receiver;
    if (is_path) { seen = path_receiver(site); } else { seen = receiver(site); }
    if (!seen.faces) { return; }
    var clear = 1e30;
    if (!is_path && has_parallel_rays()) { clear = queued.clear - dot(seen.point, dispatch.light_vector); }
    if (!light_reaches(frame.formula.fractal, seen, clear)) { return; }
    if (is_path) {
        paths[site.ray].radiance += paths[site.ray].nee_radiance;
    } else {
        visibility[site.index][light_word()] |= light_mask();
    }
}
