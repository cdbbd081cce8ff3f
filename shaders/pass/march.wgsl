// Camera rays to surface points: depth and colour data of each sample.

// No step is shorter than this part of the hit distance: what is thinner may be passed.
const LEAST_STEP = 0.25;

// Sphere tracing (Hart 1996) with a hit distance that follows the pixel's cone. 0 on a miss.
fn march(camera: Camera, fractal: Fractal, ray: Ray) -> f32 {
    let interval = bounding_interval(ray.origin, ray.direction);
    var t = interval.x;
    for (var i = 0u; i < fractal.march_steps; i++) {
        if (t > interval.y) { return 0.0; }
        let hit = hit_distance(camera, fractal, t);
        let ahead = reach(fractal, ray.origin + t * ray.direction);
        if (ahead.distance < hit) { return max(t, 1e-30); }
        t += max(ahead.step, LEAST_STEP * hit);
    }
    // Out of steps while creeping along the surface: closer than any pixel can tell.
    return t;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    picture = given_picture;
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let index = sample_index(pixel, workgroup.x, local_index);
    let ray = camera_ray(pixel);
    let fractal = picture.fractal;
    let t = march(picture.camera, fractal, ray);
    surface[index].x = bitcast<u32>(t);
    if (t == 0.0) { return; }
    let point = ray.origin + t * ray.direction;
    let colors = orbit_colors(fractal, point);
    color_data[index] = vec2u(
        pack2x16unorm(vec2f(colors.smooth_iterations / f32(fractal.iterations + 1u), colors.traps.x * 0.5)),
        pack2x16unorm(colors.traps.yz * 0.5),
    );
}
