// A path tracer in one kernel, as such kernels are usually written: the benchmark's baseline of light paths. It follows
// `literal.wgsl`, whose estimator, march, normals and colours it uses.
//
// One thread follows one path of its pixel from bounce to bounce. Rays toward the sky and to the next surface start at the
// surface and run outward, with the picture's one epsilon and step limit. Directions are of a hash-based generator, and
// weighted by the cosine. At each surface point one ray looks for the sky; a ray to the next surface that leaves the
// scene brings no light, since that ray has counted it.

struct PathSettings {
    // Radiance straight up, at the horizon, and of the ground.
    zenith: vec3f,
    // Longest way from one surface to the next, scene units.
    reach: f32,
    horizon: vec3f,
    // Farthest surface that hides the sky.
    sky_reach: f32,
    ground: vec3f,
    bounces: u32,
    // Number of the sample, for its random numbers.
    sample: u32,
}

@group(0) @binding(6) var<storage, read> path_settings: PathSettings;
// Sum of the squares of each pixel's luminance.
@group(0) @binding(7) var<storage, read_write> squares: array<f32>;

// Sine of the angle below the horizon over which the ground's colour fades in.
const HAZE = 0.1;

fn sky(direction: vec3f) -> vec3f {
    let height = direction.z;
    if (height > 0.0) { return mix(path_settings.horizon, path_settings.zenith, sqrt(height)); }
    return mix(path_settings.horizon, path_settings.ground, min(-height / HAZE, 1.0));
}

// PCG (M. Jarzynski, M. Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020).
fn pcg(x: u32) -> u32 {
    let state = x * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// The next random number, 0 to 1.
fn random(state: ptr<function, u32>) -> f32 {
    *state = pcg(*state);
    return f32(*state >> 8u) / 16777216.0;
}

// A direction about a unit normal, weighted by its cosine.
fn cosine_direction(normal: vec3f, state: ptr<function, u32>) -> vec3f {
    let azimuth = 6.2831853 * random(state);
    let z = 2.0 * random(state) - 1.0;
    let aside = sqrt(max(1.0 - z * z, 0.0));
    let sum = normal + vec3f(aside * cos(azimuth), aside * sin(azimuth), z);
    return sum / max(length(sum), 1e-6);
}

// Sphere tracing outward from a point that is lifted off the surface: the depth of the hit, 0 for a miss.
fn march_outward(point: vec3f, direction: vec3f, reach: f32, params: FormulaParams) -> f32 {
    var t = 0.0;
    for (var i = 0u; i < params.max_steps; i++) {
        let at = point + t * direction;
        if (t > reach || (length(at) > settings.bounding_radius && dot(at, direction) > 0.0)) { return 0.0; }
        let d = distance_to_set(at, params);
        if (d < 0.5 * params.epsilon) { return max(t, 1e-30); }
        t += d;
    }
    return t;
}

@compute @workgroup_size(8, 8)
fn trace_paths(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let slot = pixel_slot(workgroup, local, groups);
    if (slot.index >= arrayLength(&film) || any(slot.pixel >= settings.size_px)) { return; }
    let params = formula_params();
    var state = pcg(slot.index + pcg(path_settings.sample));
    let in_pixel = vec2f(random(&state), random(&state));
    let position = (vec2f(slot.pixel) + in_pixel) / vec2f(settings.size_px);
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * settings.half_height;
    var direction = normalize(
        settings.forward + settings.right * (on_screen.x * settings.aspect) + settings.up * on_screen.y);
    var radiance = mix(settings.background_top.rgb, settings.background_bottom.rgb, position.y);
    let depth = march(settings.eye, direction, params);
    if (depth > 0.0) {
        radiance = vec3f(0.0);
        var throughput = vec3f(1.0);
        var point = settings.eye + depth * direction;
        for (var bounce = 0u; ; bounce++) {
            let normal = six_sample_normal(point, -direction, params);
            throughput *= settings.diffuse * surface_color(orbit_colors(point, params));
            let lifted = point + normal * (2.0 * params.epsilon);
            let toward = cosine_direction(normal, &state);
            if (march_outward(lifted, toward, path_settings.sky_reach, params) == 0.0) {
                radiance += throughput * sky(toward);
            }
            if (bounce >= path_settings.bounces) { break; }
            direction = cosine_direction(normal, &state);
            let next = march_outward(lifted, direction, path_settings.reach, params);
            if (next == 0.0) { break; }
            point = lifted + next * direction;
        }
    }
    film[slot.index] += vec4f(radiance, 1.0);
    let luminance = dot(radiance, vec3f(0.2126, 0.7152, 0.0722));
    squares[slot.index] += luminance * luminance;
}
