// Marches rays to surface points: writes depth and colour data of each sample, and moves the ray there.
// uses: formula, lib/estimate_next, lib/over_relaxation, lib/sphere
// uses: types/frame_uniforms, types/gbuffer, types/ray, types/work_queues

// Least step, in hit distances; rays may pass thinner parts of the surface.
const MIN_STEP = 0.25;
// Least step, in hit distances, if hits are checked.
const MIN_STEP_WITH_HIT_CHECK = 0.4;

// Sphere tracing (Hart 1996) with the radius of the ray's cone as hit distance, from the depth `clear`
// up to which the ray is known to be clear. 0 on a miss.
fn march(fractal: Fractal, ray: Ray, clear: f32) -> f32 {
    let interval = bounding_interval(ray.origin, ray.direction);
    var t = max(interval.x, clear);
    var over = over_relaxation();
    // Depth of the last point, and the distance that was missing to a hit there.
    var before = t;
    var left = 0.0;
    let checks_hits = needs_hit_check();
    let min_step = select(MIN_STEP, MIN_STEP_WITH_HIT_CHECK, checks_hits);
    var crossing = Crossing(0.0, 0.0, 0u);
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < frame.march.march_steps; i++) {
            let is_looking = checks_hits && crossing.looks > 0u;
            let is_inside = t <= interval.y || is_looking;
            var ahead = Estimate(0.0, 0.0);
            if (is_inside) {
                ahead = estimate_next(&pending, fractal, ray.origin + t * ray.direction, ray.direction);
            }
            if (pending.is_needed) { break; }
            ahead.step = max(ahead.step, step_escalation(i, frame.march.march_steps) * ahead.distance);
            if (!is_looking) {
                let back = step_back(&over, ahead.step);
                if (back > 0.0) {
                    t -= back;
                    continue;
                }
                if (!is_inside) { return 0.0; }
            }
            let hit = hit_distance(ray, t);
            if (checks_hits && (is_looking || ahead.distance < hit)) {
                t = next_look(&crossing, before, t, hit, ahead.distance < hit);
                if (crossing.looks > LOOKS) { return max(t, 1e-30); }
                if (crossing.looks > 0u) { continue; }
            }
            if (ahead.distance < hit) {
                // Interpolates the crossing of the hit distance on the last step.
                let past = hit - ahead.distance;
                return max(mix(before, t, left / max(left + past, 1e-30)), 1e-30);
            }
            before = t;
            left = ahead.distance - hit;
            t += next_step(&over, max(ahead.step, min_step * hit));
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, ray.origin + t * ray.direction, ray.direction);
    }
    // Out of steps while creeping along the surface: closer than a pixel resolves.
    return t;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    frame = frame_uniforms;
    let queued = queued_ray(thread.x);
    let site = queued.site;
    if (!site.is_there) { return; }
    let fractal = frame.formula.fractal;
    let ray = rays[site.ray];
    let t = march(fractal, ray, queued.clear);
    surface[site.index].x = bitcast<u32>(t);
    if (t == 0.0) { return; }
    let at_surface = advanced(ray, t);
    rays[site.ray].origin = at_surface.origin;
    rays[site.ray].radius = at_surface.radius;
    let colors = orbit_colors(fractal, at_surface.origin);
    let iterations = colors.smooth_iterations / f32(frame.march.iterations + 1u);
    color_data[site.index] = vec2u(
        pack2x16unorm(vec2f(iterations, colors.traps.x * 0.5)), pack2x16unorm(colors.traps.yz * 0.5));
}
