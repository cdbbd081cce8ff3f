// Where shadow rays start and what blocks them.

// A blocker counts once it fills this cone about the ray, in radius for distance to the point:
// half the sun's own size in the sky.
const SHADOW_CONE = 0.004;

// How near the surface may come to a ray, `s` before its point.
fn blocking_distance(fractal: Fractal, s: f32, surface_distance: f32) -> f32 {
    // At low powers the estimate is small far around hairs.
    let low = saturate(4.0 - fractal.power);
    return max(mix(SHADOW_CONE, 0.5 * SHADOW_CONE, low) * s, mix(0.5, 0.15, low) * surface_distance);
}

// A sample's point as shadow rays see it.
struct Receiver {
    // Lifted off the surface, so that the point's own neighbourhood does not shade it.
    point: vec3f,
    // Its hit distance.
    surface_distance: f32,
    // Whether there is a point, and it faces the slice's light.
    faces: bool,
}

fn receiver(site: Site) -> Receiver {
    let seen = surface[site.index];
    let t = bitcast<f32>(seen.x);
    let n = octahedral_unpack(seen.y);
    let surface_distance = hit_distance(frame.camera, frame.fractal, t);
    let ray = camera_ray(site);
    let point = ray.origin + t * ray.direction + n * (2.0 * surface_distance);
    let toward = select(slice.light_vector, slice.light_vector - point, slice.light_kind == LIGHT_POINT);
    let faces = t > 0.0 && (frame.normals == NORMALS_NONE || dot(n, toward) > 0.0);
    return Receiver(point, surface_distance, faces);
}

// The slice's light among a sample's visibility bits.
fn light_word() -> u32 {
    return slice.light_bit >> 5u;
}

fn light_mask() -> u32 {
    return 1u << (slice.light_bit & 31u);
}
