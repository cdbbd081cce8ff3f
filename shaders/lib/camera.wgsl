// Rays of the pinhole camera, or of the two eyes that share a region's pixels.

struct Ray {
    origin: vec3f,
    // Unit vector.
    direction: vec3f,
}

// Where a position of an eye's own picture, (0, 0) its upper left corner and (1, 1) its lower
// right one, is seen from and along what. Both eyes' frusta meet at the screen (thesis 4.5): the
// eye moves aside by `side` half separations and its picture moves back by as much.
fn eye_ray(position: vec2f, side: f32) -> Ray {
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * frame.camera.half_height;
    let across = on_screen.x * frame.camera.aspect - side * frame.eyes.half_shift;
    return Ray(
        frame.camera.origin + frame.camera.right * (side * frame.eyes.half_separation),
        normalize(frame.camera.forward + frame.camera.right * across + frame.camera.up * on_screen.y),
    );
}

// The ray through a sample.
fn camera_ray(site: Site) -> Ray {
    return eye_ray(eye_position(site.pixel, place_in_pixel(site.sample)), eye_side(site.pixel));
}

// How close to the surface a ray must come, at this depth, to have hit it.
fn hit_distance(camera: Camera, fractal: Fractal, depth: f32) -> f32 {
    return max(camera.hit_cone * depth, fractal.finest_hit);
}
