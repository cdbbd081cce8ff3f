// Rays of the pinhole camera.

// Unit direction, in world space, of the ray through a pixel's sample position.
fn ray_direction(pixel: vec2u) -> vec3f {
    let position = (vec2f(picture.origin_px + pixel) + slice.jitter) / vec2f(picture.picture_px);
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * picture.camera.half_height;
    return normalize(picture.camera.forward
        + picture.camera.right * (on_screen.x * picture.camera.aspect)
        + picture.camera.up * on_screen.y);
}

// How close to the surface a ray must come, at this depth, to have hit it.
fn hit_distance(depth: f32) -> f32 {
    return max(picture.camera.hit_cone * depth, picture.fractal.finest_hit);
}
