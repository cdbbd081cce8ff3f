// The thesis's own algorithm, as it is printed, in a kernel of its own: what the benchmark measures
// the program against. Nothing of the program's shaders is used.
//
// Algorithm 1 with its missing line for z.y restored and its asin made exact by atan2(z, rho); one
// epsilon for the whole picture; plain sphere tracing from the eye; normals of six samples (thesis
// 3.2, figure 3.3 c); shadow rays from outside toward the point (chapter 4.5).

struct Settings {
    eye: vec3f,
    half_height: f32,
    right: vec3f,
    aspect: f32,
    up: vec3f,
    // How near to the set counts as on it, scene units.
    epsilon: f32,
    forward: vec3f,
    power: f32,
    constant: vec3f,
    divergence: f32,
    size_px: vec2u,
    // Blocks of 8x8 pixels are visited this far apart, in blocks: all of them where it is 1.
    stride: u32,
    // 1 for the Julia form.
    julia: u32,
    max_iterations: u32,
    max_steps: u32,
    // Outside of this sphere about the origin there is nothing.
    outside: f32,
    // The lights that one dispatch casts shadows of: [first, end).
    first_light: u32,
    // Where in its pixel the sample lies, 0 to 1.
    jitter: vec2f,
    end_light: u32,
    light_count: u32,
    // 0 iterations, then the traps.
    color_source: u32,
    color_repeats: f32,
    color_offset: f32,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    log_divergence: f32,
    background_top: vec4f,
    background_bottom: vec4f,
}

struct Light {
    // Unit vector toward it.
    direction: vec3f,
    casts_shadows: u32,
    color: vec3f,
    unused: u32,
}

struct Point {
    normal: vec3f,
    // Along the ray; 0 where it met nothing.
    depth: f32,
    // Smooth iterations, then least distances from the origin, the z axis, the plane z = 0.
    colors: vec4f,
}

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> lights: array<Light>;
@group(0) @binding(2) var<storage, read> gradient: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> points: array<Point>;
// A bit a light.
@group(0) @binding(4) var<storage, read_write> visibility: array<u32>;
// Sums of radiance, and the number of samples.
@group(0) @binding(5) var<storage, read_write> film: array<vec4f>;

// What Algorithm 1 requires beside the point, and how near counts. Read once a thread: some drivers
// read a buffer anew for every use, which the loops would pay for.
struct Required {
    constant: vec3f,
    power: f32,
    divergence: f32,
    epsilon: f32,
    maxiter: u32,
    maxsteps: u32,
    julia: bool,
}

fn required() -> Required {
    return Required(
        settings.constant,
        settings.power,
        settings.divergence,
        settings.epsilon,
        settings.max_iterations,
        settings.max_steps,
        settings.julia != 0u,
    );
}

// Algorithm 1.
fn distance_to_set(point: vec3f, needs: Required) -> f32 {
    let c = select(point, needs.constant, needs.julia);
    let one = select(1.0, 0.0, needs.julia);
    let power = needs.power;
    var z = point;
    var r = length(z);
    var dr = 1.0;
    var i = needs.maxiter;
    while (r <= needs.divergence && i > 0u) {
        i -= 1u;
        let ph = atan2(z.z, length(z.xy));
        let th = atan2(z.y, z.x);
        var zr = pow(r, power - 1.0);
        dr = zr * dr * power + one;
        zr *= r;
        let sph = sin(power * ph);
        let cph = cos(power * ph);
        let sth = sin(power * th);
        let cth = cos(power * th);
        z.x = zr * cph * cth + c.x;
        z.y = zr * cph * sth + c.y;
        z.z = zr * sph + c.z;
        r = length(z);
    }
    return 0.5 * log(r) * r / dr;
}

// The same orbit, for colours: thesis equation 3.1 for any power, and orbit traps.
fn orbit_colors(point: vec3f, needs: Required) -> vec4f {
    let c = select(point, needs.constant, needs.julia);
    let power = needs.power;
    var z = point;
    var r = length(z);
    var traps = vec3f(2.0);
    var i = 0u;
    while (r <= needs.divergence && i < needs.maxiter) {
        i += 1u;
        let ph = atan2(z.z, length(z.xy));
        let th = atan2(z.y, z.x);
        let zr = pow(r, power);
        z.x = zr * cos(power * ph) * cos(power * th) + c.x;
        z.y = zr * cos(power * ph) * sin(power * th) + c.y;
        z.z = zr * sin(power * ph) + c.z;
        r = length(z);
        traps = min(traps, vec3f(r, length(z.xy), abs(z.z)));
    }
    var smooth_iterations = f32(i);
    if (r > needs.divergence) {
        smooth_iterations -= log(log(r) / settings.log_divergence) / log(power);
    }
    return vec4f(smooth_iterations, traps);
}

struct Place {
    pixel: vec2u,
    index: u32,
}

fn place_of(workgroup: vec3u, local: vec3u, groups: vec3u) -> Place {
    let block = workgroup.y * groups.x + workgroup.x;
    // Every other row of blocks is moved aside, so that the visited ones are spread evenly.
    let shift = (workgroup.y * settings.stride / 2u) % settings.stride;
    let at = workgroup.xy * settings.stride + vec2u(shift, 0u);
    return Place(at * 8u + local.xy, block * 64u + local.y * 8u + local.x);
}

fn ray_direction(pixel: vec2u) -> vec3f {
    let position = (vec2f(pixel) + settings.jitter) / vec2f(settings.size_px);
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * settings.half_height;
    return normalize(settings.forward + settings.right * (on_screen.x * settings.aspect) + settings.up * on_screen.y);
}

// Steps along the ray (thesis 4.2); 0 where it met nothing.
fn march(eye: vec3f, direction: vec3f, needs: Required) -> f32 {
    var t = 0.0;
    for (var i = 0u; i < needs.maxsteps; i++) {
        let point = eye + t * direction;
        // Nothing is ahead of a ray that has passed the radius from which every orbit has escaped.
        if (length(point) > needs.divergence && dot(point, direction) > 0.0) { return 0.0; }
        let d = distance_to_set(point, needs);
        if (d < needs.epsilon) { return max(t, 1e-30); }
        t += d;
    }
    return t;
}

fn six_sample_normal(point: vec3f, toward_eye: vec3f, needs: Required) -> vec3f {
    var slope = vec3f(0.0);
    for (var axis = 0u; axis < 3u; axis++) {
        var offset = vec3f(0.0);
        offset[axis] = needs.epsilon;
        slope[axis] = distance_to_set(point + offset, needs) - distance_to_set(point - offset, needs);
    }
    let size = max(max(abs(slope.x), abs(slope.y)), abs(slope.z));
    if (!(size > 0.0)) { return toward_eye; }
    return normalize(slope / size);
}

@compute @workgroup_size(8, 8)
fn see(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let place = place_of(workgroup, local, groups);
    if (place.index >= arrayLength(&points) || any(place.pixel >= settings.size_px)) { return; }
    let direction = ray_direction(place.pixel);
    let needs = required();
    let eye = settings.eye;
    let depth = march(eye, direction, needs);
    var seen = Point(vec3f(0.0), depth, vec4f(0.0));
    if (depth > 0.0) {
        let point = eye + depth * direction;
        seen.normal = six_sample_normal(point, -direction, needs);
        seen.colors = orbit_colors(point, needs);
    }
    points[place.index] = seen;
}

// Steps from outside of the set to the point.
fn is_lit(point: vec3f, direction: vec3f, needs: Required) -> bool {
    let b = dot(point, direction);
    var s = sqrt(max(b * b - dot(point, point) + settings.outside * settings.outside, 0.0)) - b;
    for (var i = 0u; i < needs.maxsteps; i++) {
        if (s <= needs.epsilon) { return true; }
        let d = distance_to_set(point + s * direction, needs);
        if (d < 0.5 * needs.epsilon) { return false; }
        s -= d;
    }
    return true;
}

@compute @workgroup_size(8, 8)
fn shadow(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let place = place_of(workgroup, local, groups);
    if (place.index >= arrayLength(&points) || any(place.pixel >= settings.size_px)) { return; }
    let seen = points[place.index];
    if (seen.depth <= 0.0) { return; }
    let needs = required();
    // Lifted off the surface, which would otherwise shade itself.
    let point = settings.eye + seen.depth * ray_direction(place.pixel) + seen.normal * (2.0 * needs.epsilon);
    var bits = 0u;
    if (settings.first_light > 0u) { bits = visibility[place.index]; }
    let end = settings.end_light;
    for (var k = settings.first_light; k < end; k++) {
        let light = lights[k];
        if (dot(seen.normal, light.direction) <= 0.0) { continue; }
        if (light.casts_shadows == 0u || is_lit(point, light.direction, needs)) { bits |= 1u << k; }
    }
    visibility[place.index] = bits;
}

fn surface_color(colors: vec4f) -> vec3f {
    let x = fract(colors[settings.color_source] * settings.color_repeats + settings.color_offset) * f32(arrayLength(&gradient));
    let low = u32(x) % arrayLength(&gradient);
    return mix(gradient[low].rgb, gradient[(low + 1u) % arrayLength(&gradient)].rgb, fract(x));
}

// Blinn-Phong.
@compute @workgroup_size(8, 8)
fn shade(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let place = place_of(workgroup, local, groups);
    if (place.index >= arrayLength(&points) || any(place.pixel >= settings.size_px)) { return; }
    let seen = points[place.index];
    var radiance = mix(
        settings.background_top.rgb,
        settings.background_bottom.rgb,
        (f32(place.pixel.y) + settings.jitter.y) / f32(settings.size_px.y),
    );
    if (seen.depth > 0.0) {
        let toward_eye = -ray_direction(place.pixel);
        let color = surface_color(seen.colors);
        radiance = color * settings.ambient;
        for (var k = 0u; k < settings.light_count; k++) {
            if (((visibility[place.index] >> k) & 1u) == 0u) { continue; }
            let light = lights[k];
            let cosine = max(dot(seen.normal, light.direction), 0.0);
            let half_way = normalize(light.direction + toward_eye);
            let highlight = pow(max(dot(seen.normal, half_way), 0.0), settings.shininess);
            radiance += light.color * (color * (settings.diffuse * cosine) + settings.specular * highlight);
        }
    }
    film[place.index] += vec4f(radiance, 1.0);
}
