// Where shadow rays start, and the distance at which a surface blocks them.
// uses: lib/camera, lib/lattice, lib/octahedral, types/frame_uniforms, types/slice

// Distance to the surface below which a shadow ray is blocked, `s` before the point.
fn blocking_distance(s: f32, surface_distance: f32) -> f32 {
    return max(frame.march.shadow_cone * s, frame.march.shadow_margin * surface_distance);
}

// A sample's point as the target of shadow rays.
struct Receiver {
    // Lifted off the surface, so that the surface near the point does not shade it.
    point: vec3f,
    // The point's hit distance.
    surface_distance: f32,
    // True if the sample has a surface point that faces the slice's light.
    faces: bool,
}

fn receiver(site: Site) -> Receiver {
    let seen = surface[site.index];
    let t = bitcast<f32>(seen.x);
    let n = octahedral_unpack(seen.y);
    let surface_distance = hit_distance(frame.camera, t);
    let ray = camera_ray(site);
    let point = ray.origin + t * ray.direction + n * (2.0 * surface_distance);
    let toward = select(slice.light_vector, slice.light_vector - point, slice.light_kind == LIGHT_POINT);
    let faces = t > 0.0 && (frame.normals == NORMALS_NONE || dot(n, toward) > 0.0);
    return Receiver(point, surface_distance, faces);
}

// The word and the mask of the slice's light in a sample's visibility bits.
fn light_word() -> u32 {
    return slice.light_bit >> 5u;
}

fn light_mask() -> u32 {
    return 1u << (slice.light_bit & 31u);
}
