// Where shadow rays start, and the distance at which a surface blocks them.
// uses: lib/jittered, lib/lattice, lib/light_sample, lib/octahedral, lib/path_cone, types/dispatch_params
// uses: types/frame_uniforms, types/ray, types/work_queues

// Distance to the surface below which a shadow ray is blocked, `s` before the point.
fn blocking_distance(s: f32, surface_distance: f32) -> f32 {
    let cone = select(frame.march.shadow_cone, path_cone(), is_path_queue());
    return max(cone * s, frame.march.shadow_margin * surface_distance);
}

// A sample's point as the target of shadow rays.
struct Receiver {
    // Lifted off the surface, so that the surface near the point does not shade it.
    point: vec3f,
    // The point's hit distance.
    surface_distance: f32,
    // True if the sample has a surface point that faces the dispatch's light.
    faces: bool,
    // Where the sample sees the light.
    light: LightSample,
}

fn receiver(site: Site) -> Receiver {
    let seen = surface[site.index];
    let n = octahedral_unpack(seen.y);
    let ray = rays[site.ray];
    let point = ray.origin + n * (2.0 * ray.radius);
    let shape = LightShape(dispatch.light_vector, dispatch.light_kind, dispatch.light_size, dispatch.light_seed);
    let light = light_sample(shape, point, site);
    let faces = seen.x != 0u && (frame.normals == NORMALS_NONE || dot(n, light.toward) > 0.0);
    return Receiver(point, ray.radius, faces, light);
}

// Whether the rays of a block toward the dispatch's light are parallel.
fn has_parallel_rays() -> bool {
    return dispatch.light_kind != LIGHT_POINT && (dispatch.light_size <= 0.0 || !is_jittered());
}

// The word and the mask of the dispatch's light in a sample's visibility bits.
fn light_word() -> u32 {
    return dispatch.light_bit >> 5u;
}

fn light_mask() -> u32 {
    return 1u << (dispatch.light_bit & 31u);
}
