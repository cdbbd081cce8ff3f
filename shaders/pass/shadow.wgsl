// One visibility bit for each of the slice's lights: does it reach the sample's point? The bits of
// the others stay.
// Rays run inward, from where the light enters the bounding sphere to the point (thesis 4.5):
// their long steps come first.

// A blocker counts once it fills this cone about the ray, in radius for distance to the point:
// half the sun's own size in the sky.
const SHADOW_CONE = 0.004;

// No step is shorter than this part of the distance that blocks.
const LEAST_STEP = 0.25;

fn light_reaches(fractal: Fractal, point: vec3f, surface_distance: f32, light: Light) -> bool {
    var direction = light.vector;
    var farthest = light.shadow_reach;
    if (light.kind == LIGHT_POINT) {
        let to_light = light.vector - point;
        farthest = min(farthest, length(to_light));
        direction = to_light / max(farthest, 1e-30);
    }
    var s = min(farthest, bounding_interval(point, direction).y);
    for (var i = 0u; i < fractal.shadow_steps; i++) {
        if (s <= surface_distance) { return true; }
        let ahead = reach(fractal, point + s * direction);
        let blocks = max(SHADOW_CONE * s, 0.5 * surface_distance);
        if (ahead.distance < blocks) { return false; }
        s -= max(ahead.step, LEAST_STEP * blocks);
    }
    return true;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    picture = given_picture;
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let index = sample_index(pixel, workgroup.x, local_index);
    var bits = visibility[index] & ~slice.lights;
    let seen = surface[index];
    let t = bitcast<f32>(seen.x);
    if (t > 0.0) {
        let n = octahedral_unpack(seen.y);
        let fractal = picture.fractal;
        let surface_distance = hit_distance(picture.camera, fractal, t);
        // Lifted off the surface, so that the point's own neighbourhood does not shade it.
        let ray = camera_ray(pixel);
        let point = ray.origin + t * ray.direction + n * (2.0 * surface_distance);
        for (var k = 0u; k < picture.surface.light_count; k++) {
            let light = lights[k];
            if (!has_light(slice.lights, light)) { continue; }
            let toward = select(light.vector, light.vector - point, light.kind == LIGHT_POINT);
            if (picture.normals != NORMALS_NONE && dot(n, toward) <= 0.0) { continue; }
            if (light.casts_shadows == 0u || light_reaches(fractal, point, surface_distance, light)) {
                bits[light.bit >> 5u] |= 1u << (light.bit & 31u);
            }
        }
    }
    visibility[index] = bits;
}
