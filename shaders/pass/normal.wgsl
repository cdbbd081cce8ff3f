// Normals of the surface points: analytic, or one of the sampled kinds of thesis 3.2, fig. 3.3.
// uses: formula, lib/octahedral, lib/section, types/frame_uniforms, types/gbuffer, types/ray, types/work_queues

// The kind that this pipeline is specialised for; -1 reads the kind from the uniforms.
override NORMALS: i32 = -1;

fn normals_kind() -> u32 {
    if (NORMALS >= 0) { return u32(NORMALS); }
    return frame.normals;
}

// True for the grid points that a kind of normals samples, among the 3x3x3 grid about the point.
fn is_sampled(kind: u32, offset: vec3f) -> bool {
    // 0: the point itself; 1: on the axes; 2: on the faces' diagonals; 3: at the corners.
    let axes = dot(abs(offset), vec3f(1.0));
    switch kind {
        case NORMALS_THREE: { return axes <= 1.0 && all(offset >= vec3f(0.0)); }
        case NORMALS_SIX: { return axes == 1.0; }
        case NORMALS_EIGHTEEN: { return axes == 1.0 || axes == 2.0; }
        default: { return axes > 0.0; }
    }
}

// The gradient, not normalised, of the linear function that fits the samples best (least squares):
// by symmetry the sum of each value times its offset. Three samples use differences to the point itself.
fn sampled_gradient(kind: u32, fractal: Fractal, center: vec3f, spacing: f32) -> vec3f {
    var gradient = vec3f(0.0);
    for (var k = 0u; k < 27u; k++) {
        let offset = vec3f(vec3u(k % 3u, k / 3u % 3u, k / 9u)) - 1.0;
        if (!is_sampled(kind, offset)) { continue; }
        let weight = select(offset, vec3f(-1.0), all(offset == vec3f(0.0)));
        gradient += weight * distance_estimate(fractal, center + spacing * offset);
    }
    return gradient;
}

// How far a normal that faced away is turned toward the eye beyond a right angle, radians: more than packing rounds.
const FACING = 0.01;

// The direction nearest to `normal` that faces the eye: the ray came from outside.
fn turned_to_eye(normal: vec3f, toward_eye: vec3f) -> vec3f {
    let toward = dot(normal, toward_eye);
    if (toward >= 0.0) { return normal; }
    let across = normal - toward * toward_eye;
    let length = length(across);
    if (length < 1e-4) { return toward_eye; }
    return normalize(across / length + FACING * toward_eye);
}

// True if the estimate ripples below a pixel: the gradient at the point faces away from the eye, or is 0 inside the set.
fn is_rippled(gradient: vec3f, toward_eye: vec3f) -> bool {
    return dot(gradient, toward_eye) < 0.0 || all(gradient == vec3f(0.0));
}

// Points toward the eye if the gradient is zero, or if normals are off.
fn surface_normal(fractal: Fractal, point: vec3f, spacing: f32, toward_eye: vec3f) -> vec3f {
    var kind = normals_kind();
    var gradient = vec3f(0.0);
    let is_analytic = kind == NORMALS_ANALYTIC;
    var center = point;
    if (is_analytic) {
        gradient = distance_gradient(fractal, point);
        kind = select(NORMALS_NONE, NORMALS_TWENTY_SIX, is_rippled(gradient, toward_eye));
        // The grid ends at the point: in front of it the estimate falls toward the surface, and the ripples lie behind.
        center += spacing * toward_eye;
    }
    if (kind != NORMALS_NONE) { gradient = sampled_gradient(kind, fractal, center, spacing); }
    // The square of the gradient's length may overflow an f32.
    let largest = max(max(abs(gradient.x), abs(gradient.y)), abs(gradient.z));
    if (largest <= 0.0) { return toward_eye; }
    let normal = normalize(gradient / largest);
    if (is_analytic) { return turned_to_eye(normal, toward_eye); }
    return normal;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let site = queued_hit(thread.x);
    if (!site.is_there) { return; }
    if (surface[site.index].x == 0u) { return; }
    let ray = rays[site.ray];
    var n = vec3f(0.0);
    if (color_data[site.index].y == ON_SECTION) {
        n = section_normal(ray.origin);
    } else {
        n = surface_normal(frame.formula.fractal, ray.origin, ray.radius, -ray.direction);
    }
    surface[site.index].y = octahedral_pack(n);
}
