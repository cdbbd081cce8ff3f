// Distance estimates, safe steps, gradients and colour data at given points.
// uses: formula, types/frame_uniforms

struct Answer {
    // Of any length.
    gradient: vec3f,
    distance: f32,
    // Smooth iteration count, traps of the two layers.
    colors: vec3f,
    step: f32,
    // The distance by `quick_estimate`; negative where that cannot tell.
    quick_distance: f32,
    channel: f32,
}

// xyz: the point. w: unused.
@group(1) @binding(0) var<storage, read_write> points: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> answers: array<Answer>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    read_frame();
    if (id.x >= arrayLength(&points)) { return; }
    let point = points[id.x].xyz;
    let fractal = frame.formula.fractal;
    let colors = orbit_colors(fractal, point);
    let ahead = estimate(fractal, point, cone_direction());
    let quick = quick_estimate(fractal, point, cone_direction());
    answers[id.x] = Answer(
        distance_gradient(fractal, point),
        ahead.distance,
        vec3f(colors.smooth_iterations, colors.traps),
        ahead.step,
        select(quick.distance, -1.0, quick.step < 0.0),
        colors.channel,
    );
}
