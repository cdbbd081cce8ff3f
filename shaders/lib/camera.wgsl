// Camera rays. In stereo each eye has its own.
// uses: lib/eye, lib/lattice, lib/lens, types/frame_uniforms, types/ray

// The ray of an eye through a position of its own picture: (0, 0) is the picture's upper left corner,
// (1, 1) the lower right one. Both eyes' frusta meet at the screen (thesis 4.5): the eye moves
// aside by `side` half separations, and its picture moves back by as much.
fn eye_ray(position: vec2f, side: f32) -> Ray {
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * frame.camera.half_height;
    let across = on_screen.x * frame.camera.aspect - side * frame.eyes.half_shift;
    return Ray(
        frame.camera.origin + frame.camera.right * (side * frame.eyes.half_separation),
        0.0,
        normalize(frame.camera.forward + frame.camera.right * across + frame.camera.up * on_screen.y),
        frame.camera.hit_cone,
    );
}

// The ray of the eye through a sample.
fn camera_ray(site: Site) -> Ray {
    let ray = eye_ray(eye_position(site.pixel, place_in_pixel(site.sample)), eye_side(site.pixel));
    return through_lens(ray, site);
}
