// Follows rays through the set as a medium: writes the depth of the first collision of each ray, and moves the ray
// there. For shadow rays of paths, adds the chosen light's light if there is no collision. Both by delta tracking
// (E. Woodcock et al., Techniques used in the GEM code, 1965; J. Novak et al., Monte Carlo Methods for Volumetric
// Light Transport Simulation, CGF 37(2), 2018, section 4.2).
// uses: formula, lib/density, lib/estimate_next, lib/jittered, lib/lattice, lib/path_cone, lib/sphere
// uses: types/dispatch_params, types/frame_uniforms, types/gbuffer, types/paths, types/ray, types/work_queues

// Numbers of the random pairs of a ray's steps; other purposes have other numbers.
const FIRST_STEP_PAIR = 0x10000u;
// More than any ray has steps.
const STEP_PAIRS = 0x1000u;

// Least step through empty space, in hit distances.
const MIN_STEP = 0.25;

// A third of the steps of a march: a step here may follow three orbits.
fn max_steps() -> u32 {
    return max(frame.march.march_steps / 3u, 1u);
}

// Depth of the first collision along a ray, of which the part up to `clear` is empty; 0 if there is none.
fn collision(fractal: Fractal, site: Site, ray: Ray, interval: vec2f, clear: f32) -> f32 {
    // In a cloud at least so long that the steps suffice.
    let least = select(4.0 * (interval.y - interval.x) / f32(max_steps()), 0.0, is_empty_outside());
    let free_path = max(frame.medium.mean_free_path, least);
    let first_pair = FIRST_STEP_PAIR + STEP_PAIRS * dispatch.ray_queue;
    var t = max(interval.x, clear);
    var i = 0u;
    // Without a cone before it, the first step has no limit but its own.
    var longest_step = 1e30;
    if (t > interval.x) { longest_step = largest_ball_behind_cone(ray, t); }
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < max_steps() && t <= interval.y; i++) {
            let point = ray.origin + t * ray.direction;
            if (is_empty_outside()) {
                // No medium within the safe step: the free path starts anew behind it.
                let ahead = estimate_next(&pending, fractal, point, ray.direction);
                if (pending.is_needed) { break; }
                let hit = hit_distance(ray, t);
                // Some estimates are positive inside of the set.
                if (ahead.distance > hit && !orbit_colors(fractal, point).is_inside) {
                    let step = max(min(ahead.step, longest_step), MIN_STEP * hit);
                    longest_step = frame.march.ball_growth * step;
                    t += step;
                    continue;
                }
            }
            let u = random_pair(site, first_pair + i);
            t -= log(max(1.0 - u.x, 1e-12)) * free_path;
            if (t > interval.y) { return 0.0; }
            if (u.y < medium_density(fractal, ray.origin + t * ray.direction)) { return max(t, 1e-30); }
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, ray.origin + t * ray.direction, ray.direction);
    }
    // Out of steps, while creeping along the set.
    return select(0.0, t, t <= interval.y);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let queued = queued_ray(thread.x);
    let site = queued.site;
    if (!site.is_there) { return; }
    let fractal = frame.formula.fractal;
    let is_shadow = dispatch.queue_region == SHADOW_REGION;
    var ray = rays[site.ray];
    var clear = queued.clear;
    if (is_path_queue()) { clear = 0.0; }
    if (is_shadow) { ray = Ray(ray.origin, ray.radius, paths[site.ray].nee_direction, path_cone()); }
    var interval = bounding_interval(ray.origin, ray.direction, frame.march.bounding_radius);
    if (is_shadow) {
        interval.y = min(interval.y, paths[site.ray].nee_distance);
    } else if (dispatch.bounce > 0u) {
        interval.y = min(interval.y, min(frame.paths.ray_reach, stored_fog_distance(site.index)));
    }
    let depth = collision(fractal, site, ray, interval, clear);
    if (is_shadow) {
        if (depth == 0.0) { paths[site.ray].radiance += paths[site.ray].nee_radiance; }
        return;
    }
    surface[site.index].x = bitcast<u32>(depth);
    if (depth == 0.0) { return; }
    let there = advanced(ray, depth);
    rays[site.ray].origin = there.origin;
    rays[site.ray].radius = there.radius;
}
