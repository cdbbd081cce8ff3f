// Distance estimates and colour data at given points: how tests ask the kernels themselves.

// xyz: the point. w: unused.
@group(1) @binding(0) var<storage, read_write> points: array<vec4f>;
// Distance estimate, smooth iteration count, origin trap, axis trap.
@group(1) @binding(1) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&points)) { return; }
    let point = points[id.x].xyz;
    let colors = orbit_colors(point);
    answers[id.x] = vec4f(distance_estimate(point), colors.smooth_iterations, colors.traps.xy);
}
