// Distance estimates, their gradients and colour data at given points: how tests ask the kernels
// themselves.

struct Answer {
    // Of any length.
    gradient: vec3f,
    distance: f32,
    // Smooth iteration count, origin trap, axis trap. w: unused.
    colors: vec4f,
}

// xyz: the point. w: unused.
@group(1) @binding(0) var<storage, read_write> points: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> answers: array<Answer>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    picture = given_picture;
    if (id.x >= arrayLength(&points)) { return; }
    let point = points[id.x].xyz;
    let fractal = picture.fractal;
    let colors = orbit_colors(fractal, point);
    answers[id.x] = Answer(
        distance_gradient(fractal, point),
        distance_estimate(fractal, point),
        vec4f(colors.smooth_iterations, colors.traps.xy, 0.0),
    );
}
