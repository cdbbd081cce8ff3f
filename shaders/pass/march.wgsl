// Marches rays to surface points: writes depth and colour data of each sample, and moves the ray there.
// uses: formula, lib/estimate_next, lib/over_relaxation, lib/section, lib/sphere
// uses: types/dispatch_params, types/estimate, types/frame_uniforms, types/gbuffer, types/ray, types/work_queues

// Least step, in hit distances; rays may pass thinner parts of the surface.
const MIN_STEP = 0.25;
// Least step, in hit distances, if hits are checked.
const MIN_STEP_WITH_HIT_CHECK = 0.4;

// Longest step, in hit distances, on which the crossing of the hit distance is interpolated. On longer ones it is
// sought by bisection: they may have ended deep inside the set.
const WIDEST_CROSSING = 4.0;

// Before a ray's first point no distance is known; a crossing on the way to that point is placed at it.
const UNKNOWN_LEFT = 1e30;

// A ray stays with a surface until it is so many colour distances away: gaps that only a fine picture
// resolves keep the colours of their rim. A larger factor paints wider rims on what lies behind.
const LEAVING = 8.0;

// The way of a ray to the point whose orbit gives its colours. Rays of all pixels come within the colour
// distance at the same points, but hit at points that depend on the pixel.
struct ColorPoint {
    // Depth at which the ray came within the colour distance; 0 before, and once it has left again.
    depth: f32,
    // Distance that was missing at the last point of the march.
    left: f32,
}

// The colour point after a march's step from depth `before` to `t`; `within`: the colour distance there.
fn next_color_point(point: ColorPoint, before: f32, t: f32, distance: f32, within: f32) -> ColorPoint {
    let left = max(distance - within, 0.0);
    var depth = select(point.depth, 0.0, distance > LEAVING * within);
    if (depth == 0.0 && distance < within) {
        depth = mix(before, t, point.left / max(point.left + within - distance, 1e-30));
    }
    return ColorPoint(depth, left);
}

// Where a ray ends.
struct RayEnd {
    // Depth of the surface; 0 on a miss.
    surface: f32,
    // Depth of the point whose orbit gives the colours.
    colors: f32,
    // Whether the ray ends on a section plane.
    is_on_section: bool,
}

// Colours are taken at the surface if the hit distance is greater than the colour distance, or if the first point of the
// ray is inside.
fn ray_end(surface: f32, colors: ColorPoint) -> RayEnd {
    return RayEnd(surface, select(surface, min(colors.depth, surface), colors.depth > 0.0), false);
}

fn is_bounced() -> bool {
    return dispatch.bounce > 0u;
}

// Sphere tracing (Hart 1996) with the radius of the ray's cone as hit distance, inside the ray's interval, from the
// depth `clear` up to which the ray is known to be clear.
fn march(fractal: Fractal, ray: Ray, interval: vec2f, cut: SectionEntry, clear: f32) -> RayEnd {
    var t = max(interval.x, clear);
    var is_on_section = cut.depth > 0.0 && t <= 1.000001 * cut.depth;
    var over = over_relaxation();
    if (t == 0.0 && !is_bounced()) { over.next = STEP_FROM_EYE; }
    if (t > interval.x && !is_bounced()) { over.max_ball = largest_ball_behind_cone(ray, t); }
    // Depth of the last point, and the distance that was missing to a hit there. A cone may end inside the set where its
    // estimate is too large: the way to a ray's first point starts at the bounding sphere.
    var before = interval.x;
    var left = UNKNOWN_LEFT;
    // Depth along `forward` is the same for both eyes. Bounced rays take the colours of the surface.
    let color_spread = select(frame.camera.color_cone * dot(ray.direction, frame.camera.forward), 0.0, is_bounced());
    var colors = ColorPoint(0.0, UNKNOWN_LEFT);
    let checks_hits = needs_hit_check();
    let min_step = select(MIN_STEP, MIN_STEP_WITH_HIT_CHECK, checks_hits);
    var crossing = Crossing(0.0, 0.0, 0u, 0u);
    // Depth of a point within the hit distance, while the crossing before it is sought; 0 before.
    var within_hit = 0.0;
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < frame.march.march_steps; i++) {
            let is_looking = (checks_hits && crossing.looks > 0u) || within_hit > 0.0;
            let is_inside = t <= interval.y || is_looking;
            var ahead = Estimate(0.0, 0.0);
            if (is_inside) {
                ahead = estimate_next(&pending, fractal, ray.origin + t * ray.direction, ray.direction);
            }
            if (pending.is_needed) { break; }
            ahead.step = empty_ball(over, ahead, i, frame.march.march_steps);
            if (!is_looking) {
                let back = step_back(&over, ahead.step);
                if (back > 0.0) {
                    t -= back;
                    continue;
                }
                if (!is_inside) { return RayEnd(0.0, 0.0, false); }
            }
            let hit = hit_distance(ray, t);
            if (is_on_section && ahead.distance < max(hit, cut.band_reach)) {
                return RayEnd(t, t, true);
            }
            is_on_section = false;
            let within = color_spread * t;
            if (!is_looking && within > hit) {
                colors = next_color_point(colors, before, t, ahead.distance, within);
            }
            if (checks_hits && within_hit == 0.0 && (is_looking || ahead.distance < hit)) {
                t = next_look(&crossing, before, t, hit, ahead.distance < hit);
                if (crossing.near_checks == frame.march.near_checks) { return ray_end(max(t, 1e-30), colors); }
                if (crossing.looks > 0u) { continue; }
            }
            let is_near = ahead.distance < hit;
            if (is_near && t - before <= WIDEST_CROSSING * hit) {
                // Interpolates the crossing of the hit distance on the last step.
                let past = hit - ahead.distance;
                return ray_end(max(mix(before, t, left / max(left + past, 1e-30)), 1e-30), colors);
            }
            if (is_near) {
                within_hit = t;
            } else {
                before = t;
                left = ahead.distance - hit;
            }
            if (within_hit > 0.0) {
                // After a step that was too long the crossing is anywhere on it.
                t = 0.5 * (before + within_hit);
                continue;
            }
            t += next_step(&over, max(ahead.step, min_step * hit));
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, ray.origin + t * ray.direction, ray.direction);
    }
    // Out of steps while creeping along the surface: closer than a pixel resolves.
    return ray_end(t, colors);
}

// The value that an orbit, or the hit in render space, gives to a colour layer.
fn layer_value(layer: ColorLayer, colors: OrbitColors, trap: f32, hit: vec3f) -> f32 {
    switch layer.source {
        case COLOR_ITERATIONS: { return colors.smooth_iterations; }
        case COLOR_CHANNEL: { return colors.channel; }
        case COLOR_POSITION: {
            let position = frame.march.anchor + frame.march.scale * hit;
            return 0.5 + 0.5 * dot(position, layer.axis) / frame.march.bounding_radius;
        }
        default: { return trap; }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let queued = queued_ray(thread.x);
    let site = queued.site;
    if (!site.is_there) { return; }
    let fractal = frame.formula.fractal;
    let ray = rays[site.ray];
    let beside = select(frame.march.radius_beside, frame.march.bounding_radius, is_bounced());
    var interval = bounding_interval(ray.origin, ray.direction, beside);
    if (is_bounced()) { interval.y = min(interval.y, min(frame.paths.ray_reach, stored_fog_distance(site.index))); }
    let cut = section_entry(ray.origin, ray.direction);
    // A ray that enters the set through a section plane ends there. Estimates are no test for that: some are positive
    // inside. The loop has one turn without section planes, and one copy of the orbit's code.
    var is_cut = cut.depth > 0.0 && interval.x <= 1.000001 * cut.depth && interval.x <= interval.y;
    var end = RayEnd(cut.depth, cut.depth, true);
    var colors: OrbitColors;
    for (; ; ) {
        if (!is_cut) { end = march(fractal, ray, interval, cut, queued.clear); }
        surface[site.index].x = bitcast<u32>(end.surface);
        if (end.surface == 0.0) { return; }
        colors = orbit_colors(fractal, ray.origin + end.colors * ray.direction);
        if (!is_cut || colors.is_inside) { break; }
        is_cut = false;
    }
    let at_surface = advanced(ray, end.surface);
    rays[site.ray].origin = at_surface.origin;
    rays[site.ray].radius = at_surface.radius;
    if (end.is_on_section) {
        color_data[site.index] = vec2f(select(colors.smooth_iterations, -1.0, colors.is_inside), ON_SECTION);
        return;
    }
    color_data[site.index] = vec2f(
        layer_value(frame.first_layer, colors, colors.traps.x, at_surface.origin),
        layer_value(frame.second_layer, colors, colors.traps.y, at_surface.origin));
}
