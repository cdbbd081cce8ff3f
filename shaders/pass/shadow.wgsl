// The visibility bit of the slice's light: does it reach the sample's point? The bits of others stay.
// Rays run inward, from where the light enters the bounding sphere to the point (thesis 4.5):
// their long steps come first.

// A blocker counts once it fills this cone about the ray, in radius for distance to the point:
// half the sun's own size in the sky.
const SHADOW_CONE = 0.004;

// No step is shorter than this part of the distance that blocks.
const LEAST_STEP = 0.25;

// How near the surface may come to a ray, `s` before its point.
fn blocking_distance(s: f32, surface_distance: f32) -> f32 {
    return max(SHADOW_CONE * s, 0.5 * surface_distance);
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
    var pace = paced(fractal.power);
    for (var i = 0u; i < fractal.shadow_steps; i++) {
        var ahead = Reach(0.0, 0.0);
        if (s > surface_distance) { ahead = reach(fractal, point + s * direction); }
        let back = step_back(&pace, ahead.step);
        s += back;
        // Where a step too long is taken back, what is left may be known to be empty.
        if (s <= surface_distance) { return true; }
        if (back > 0.0) { continue; }
        let blocks = blocking_distance(s, surface_distance);
        if (ahead.distance < blocks) { return false; }
        s -= next_step(&pace, max(ahead.step, LEAST_STEP * blocks));
    }
    return true;
}

// The workgroup's points that face the light, lifted, and their hit distances: 0 where there is
// none.
var<workgroup> points: array<vec4f, WORKGROUP_THREADS>;
// How far along the light's direction the plane lies that rays to all points of a block come to
// unblocked.
var<workgroup> clear_plane: array<f32, BLOCKS>;

// That plane for a block, where the light is no point light.
fn clear_block(fractal: Fractal, block: u32) -> f32 {
    let direction = slice.light_vector;
    let first = block * BLOCK_THREADS;
    var low = vec3f(1e30);
    var high = vec3f(-1e30);
    var surface_distance = 0.0;
    for (var i = first; i < first + BLOCK_THREADS; i++) {
        if (points[i].w == 0.0) { continue; }
        low = min(low, points[i].xyz);
        high = max(high, points[i].xyz);
        surface_distance = max(surface_distance, points[i].w);
    }
    if (surface_distance == 0.0) { return 1e30; }
    let center = 0.5 * (low + high);
    var width = 0.0;
    var extent = 0.0;
    for (var i = first; i < first + BLOCK_THREADS; i++) {
        if (points[i].w == 0.0) { continue; }
        let offset = points[i].xyz - center;
        let along = dot(offset, direction);
        width = max(width, length(offset - along * direction));
        extent = max(extent, along);
    }
    // Where the last of the rays leaves the bounding sphere, or where shadows end.
    let height = dot(center, direction);
    let aside = max(length(center - height * direction) - width, 0.0);
    let leaves = sqrt(max(fractal.bounding_radius * fractal.bounding_radius - aside * aside, 0.0)) - height;
    let part = ball_part(fractal.power);
    var s = min(leaves, slice.light_reach + extent);
    for (var i = 0u; i < BUNDLE_STEPS; i++) {
        // No point is farther than this from the plane through `s`.
        let blocks = blocking_distance(s + extent, surface_distance);
        let ball = part * reach(fractal, center + s * direction).step - blocks;
        let advance = sqrt(max(ball * ball - width * width, 0.0));
        if (ball <= width || advance <= width) { break; }
        s -= advance;
    }
    return height + s;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    picture = given_picture;
    let fractal = picture.fractal;
    let pixel = lattice_pixel(workgroup.x, local_index);
    let index = sample_index(pixel, workgroup.x, local_index);
    var seen = vec2u(0u);
    if (inside_region(pixel)) { seen = surface[index]; }
    let t = bitcast<f32>(seen.x);
    let n = octahedral_unpack(seen.y);
    let surface_distance = hit_distance(picture.camera, fractal, t);
    // Lifted off the surface, so that the point's own neighbourhood does not shade it.
    let ray = camera_ray(pixel);
    let point = ray.origin + t * ray.direction + n * (2.0 * surface_distance);
    let is_point_light = slice.light_kind == LIGHT_POINT;
    let toward = select(slice.light_vector, slice.light_vector - point, is_point_light);
    let faces = t > 0.0 && (picture.normals == NORMALS_NONE || dot(n, toward) > 0.0);
    points[local_index] = vec4f(point, select(0.0, surface_distance, faces));
    workgroupBarrier();
    if (local_index < BLOCKS) {
        clear_plane[local_index] = 1e30;
        if (!is_point_light) { clear_plane[local_index] = clear_block(fractal, local_index); }
    }
    workgroupBarrier();
    if (!inside_region(pixel)) { return; }
    var is_lit = false;
    if (faces) {
        let clear = clear_plane[local_index / BLOCK_THREADS] - dot(point, slice.light_vector);
        is_lit = light_reaches(fractal, point, surface_distance, select(clear, 1e30, is_point_light));
    }
    let word = slice.light_bit >> 5u;
    let bit = 1u << (slice.light_bit & 31u);
    visibility[index][word] = (visibility[index][word] & ~bit) | select(0u, bit, is_lit);
}
