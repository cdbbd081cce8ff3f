// The thesis's own algorithm as printed: the baseline of the benchmark. Shares no shader with
// the program.
//
// Algorithm 1 with its missing line for z.y restored and its asin made exact by atan2(z, rho);
// one epsilon for the whole picture; plain sphere tracing from the eye; normals of six samples
// (thesis 3.2, figure 3.3 c); shadow rays from outside of the set toward the point (chapter
// 4.5).

struct Settings {
    eye: vec3f,
    half_height: f32,
    right: vec3f,
    aspect: f32,
    up: vec3f,
    // Hit distance, scene units.
    epsilon: f32,
    forward: vec3f,
    power: f32,
    constant: vec3f,
    bailout: f32,
    size_px: vec2u,
    // Distance between drawn blocks of 8x8 pixels, in blocks; 1 draws all of them.
    stride: u32,
    // 1 for the Julia form.
    julia: u32,
    max_iterations: u32,
    max_steps: u32,
    // Radius of a sphere about the origin that contains the set.
    bounding_radius: f32,
    // The lights of one shadow dispatch: [first, end).
    first_light: u32,
    // Position of the sample in its pixel, 0 to 1.
    jitter: vec2f,
    end_light: u32,
    light_count: u32,
    // 0 for smooth iterations, then the orbit traps.
    color_source: u32,
    color_repeats: f32,
    color_offset: f32,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    log_bailout: f32,
    background_top: vec4f,
    background_bottom: vec4f,
}

struct Light {
    // Unit vector toward the light.
    direction: vec3f,
    casts_shadows: u32,
    color: vec3f,
    unused: u32,
}

struct Point {
    normal: vec3f,
    // Depth along the ray; 0 for a miss.
    depth: f32,
    // Smooth iterations, then the orbit's least distances to the origin, the z axis and the
    // plane z = 0.
    colors: vec4f,
}

@group(0) @binding(0) var<storage, read> settings: Settings;
@group(0) @binding(1) var<storage, read> lights: array<Light>;
@group(0) @binding(2) var<storage, read> gradient: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> points: array<Point>;
// Bit k is set if light k reaches the point.
@group(0) @binding(4) var<storage, read_write> visibility: array<u32>;
// Sum of radiance, and the number of samples.
@group(0) @binding(5) var<storage, read_write> film: array<vec4f>;

// The parameters of Algorithm 1, and the limits of a march. Each thread reads them once: some
// drivers read a buffer again at every use inside of a loop.
struct FormulaParams {
    constant: vec3f,
    power: f32,
    bailout: f32,
    epsilon: f32,
    max_iterations: u32,
    max_steps: u32,
    julia: bool,
}

fn formula_params() -> FormulaParams {
    return FormulaParams(
        settings.constant,
        settings.power,
        settings.bailout,
        settings.epsilon,
        settings.max_iterations,
        settings.max_steps,
        settings.julia != 0u,
    );
}

// Algorithm 1.
fn distance_to_set(point: vec3f, params: FormulaParams) -> f32 {
    let c = select(point, params.constant, params.julia);
    let one = select(1.0, 0.0, params.julia);
    let power = params.power;
    var z = point;
    var r = length(z);
    var dr = 1.0;
    var i = params.max_iterations;
    while (r <= params.bailout && i > 0u) {
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

// The same orbit for colours: thesis equation 3.1 for any power, and orbit traps.
fn orbit_colors(point: vec3f, params: FormulaParams) -> vec4f {
    let c = select(point, params.constant, params.julia);
    let power = params.power;
    var z = point;
    var r = length(z);
    var traps = vec3f(2.0);
    var i = 0u;
    while (r <= params.bailout && i < params.max_iterations) {
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
    if (r > params.bailout) {
        smooth_iterations -= log(log(r) / settings.log_bailout) / log(power);
    }
    return vec4f(smooth_iterations, traps);
}

struct PixelSlot {
    pixel: vec2u,
    index: u32,
}

fn pixel_slot(workgroup: vec3u, local: vec3u, groups: vec3u) -> PixelSlot {
    let block = workgroup.y * groups.x + workgroup.x;
    // Every other row of blocks is shifted, so that the drawn blocks are spread evenly.
    let shift = (workgroup.y * settings.stride / 2u) % settings.stride;
    let at = workgroup.xy * settings.stride + vec2u(shift, 0u);
    return PixelSlot(at * 8u + local.xy, block * 64u + local.y * 8u + local.x);
}

fn ray_direction(pixel: vec2u) -> vec3f {
    let position = (vec2f(pixel) + settings.jitter) / vec2f(settings.size_px);
    let on_screen = vec2f(2.0 * position.x - 1.0, 1.0 - 2.0 * position.y) * settings.half_height;
    return normalize(settings.forward + settings.right * (on_screen.x * settings.aspect) + settings.up * on_screen.y);
}

// Sphere tracing along a ray (thesis 4.2): the depth of the hit, 0 for a miss.
fn march(eye: vec3f, direction: vec3f, params: FormulaParams) -> f32 {
    var t = 0.0;
    for (var i = 0u; i < params.max_steps; i++) {
        let point = eye + t * direction;
        // A ray that leaves the bailout radius outward can't hit the set any more.
        if (length(point) > params.bailout && dot(point, direction) > 0.0) { return 0.0; }
        let d = distance_to_set(point, params);
        if (d < params.epsilon) { return max(t, 1e-30); }
        t += d;
    }
    return t;
}

fn six_sample_normal(point: vec3f, toward_eye: vec3f, params: FormulaParams) -> vec3f {
    var gradient_sum = vec3f(0.0);
    for (var axis = 0u; axis < 3u; axis++) {
        var offset = vec3f(0.0);
        offset[axis] = params.epsilon;
        gradient_sum[axis] = distance_to_set(point + offset, params) - distance_to_set(point - offset, params);
    }
    let size = max(max(abs(gradient_sum.x), abs(gradient_sum.y)), abs(gradient_sum.z));
    if (!(size > 0.0)) { return toward_eye; }
    return normalize(gradient_sum / size);
}

@compute @workgroup_size(8, 8)
fn primary(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_id) local: vec3u,
) {
    let slot = pixel_slot(workgroup, local, groups);
    if (slot.index >= arrayLength(&points) || any(slot.pixel >= settings.size_px)) { return; }
    let direction = ray_direction(slot.pixel);
    let params = formula_params();
    let eye = settings.eye;
    let depth = march(eye, direction, params);
    var surface = Point(vec3f(0.0), depth, vec4f(0.0));
    if (depth > 0.0) {
        let point = eye + depth * direction;
        surface.normal = six_sample_normal(point, -direction, params);
        surface.colors = orbit_colors(point, params);
    }
    points[slot.index] = surface;
}

// True if a march from outside of the set reaches the point.
fn is_lit(point: vec3f, direction: vec3f, params: FormulaParams) -> bool {
    let b = dot(point, direction);
    var s = sqrt(max(b * b - dot(point, point) + settings.bounding_radius * settings.bounding_radius, 0.0)) - b;
    for (var i = 0u; i < params.max_steps; i++) {
        if (s <= params.epsilon) { return true; }
        let d = distance_to_set(point + s * direction, params);
        if (d < 0.5 * params.epsilon) { return false; }
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
    let slot = pixel_slot(workgroup, local, groups);
    if (slot.index >= arrayLength(&points) || any(slot.pixel >= settings.size_px)) { return; }
    let surface = points[slot.index];
    if (surface.depth <= 0.0) { return; }
    let params = formula_params();
    // Lifts the point off the surface, which would otherwise occlude itself.
    let point = settings.eye + surface.depth * ray_direction(slot.pixel) + surface.normal * (2.0 * params.epsilon);
    var bits = 0u;
    if (settings.first_light > 0u) { bits = visibility[slot.index]; }
    let end = settings.end_light;
    for (var k = settings.first_light; k < end; k++) {
        let light = lights[k];
        if (dot(surface.normal, light.direction) <= 0.0) { continue; }
        if (light.casts_shadows == 0u || is_lit(point, light.direction, params)) { bits |= 1u << k; }
    }
    visibility[slot.index] = bits;
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
    let slot = pixel_slot(workgroup, local, groups);
    if (slot.index >= arrayLength(&points) || any(slot.pixel >= settings.size_px)) { return; }
    let surface = points[slot.index];
    var radiance = mix(
        settings.background_top.rgb,
        settings.background_bottom.rgb,
        (f32(slot.pixel.y) + settings.jitter.y) / f32(settings.size_px.y),
    );
    if (surface.depth > 0.0) {
        let toward_eye = -ray_direction(slot.pixel);
        let color = surface_color(surface.colors);
        radiance = color * settings.ambient;
        for (var k = 0u; k < settings.light_count; k++) {
            if (((visibility[slot.index] >> k) & 1u) == 0u) { continue; }
            let light = lights[k];
            let cosine = max(dot(surface.normal, light.direction), 0.0);
            let half_way = normalize(light.direction + toward_eye);
            let highlight = pow(max(dot(surface.normal, half_way), 0.0), settings.shininess);
            radiance += light.color * (color * (settings.diffuse * cosine) + settings.specular * highlight);
        }
    }
    film[slot.index] += vec4f(radiance, 1.0);
}
