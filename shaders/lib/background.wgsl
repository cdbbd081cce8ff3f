// What a camera ray sees that meets no surface.
// uses: lib/environment_map, types/frame_uniforms

// Whether this pipeline shows the environment map: 0 no, 1 yes, -1 reads it from the uniforms.
override HAS_ENVIRONMENT_MAP: i32 = -1;

fn has_environment_map() -> bool {
    if (HAS_ENVIRONMENT_MAP >= 0) { return HAS_ENVIRONMENT_MAP == 1; }
    return frame.background.map_gain > 0.0;
}

// Whether the background is transparent: 0 no, 1 yes, -1 reads it from the uniforms.
override TRANSPARENT: i32 = -1;

fn is_transparent() -> bool {
    if (TRANSPARENT >= 0) { return TRANSPARENT == 1; }
    return frame.background.transparent_samples > 0.0;
}

// The background that a ray without a hit sees; `height` is 0 at the picture's upper edge, 1 at the lower.
fn background(direction: vec3f, height: f32) -> vec3f {
    let behind = frame.background;
    if (is_transparent()) { return vec3f(0.0); }
    if (!has_environment_map()) { return mix(behind.top.rgb, behind.bottom.rgb, height); }
    let in_map = vec3f(
        dot(direction, behind.map_x), dot(direction, behind.map_y), dot(direction, behind.map_z));
    return behind.map_gain * environment_at(in_map);
}
