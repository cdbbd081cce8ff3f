// Estimates and gradients of a text that gives no running derivative: one direction is carried along, the
// ray's own. From `operations.rs`, besides those of `orbit`:
//     next_with_tangent, next_with_rows     a step with the state's derivatives in one and in three directions
//     distance_at, distance_slope           the estimate at an orbit's end, and its derivatives

fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    load_slots();
    let direction = select(ANY_DIRECTION, along, dot(along, along) > 0.0);
    let c = addend(fractal, point);
    let moved = initial_tangent(point, direction);
    var z = initial(point);
    var tangent = moved;
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        let next = next_with_tangent(
            n, z, c, point, fractal.addend_derivative, tangent, fractal.addend_derivative * moved, direction);
        z = next.z;
        tangent = clamp(next.tangent, State(-1e18), State(1e18));
    }
    return estimate_of(fractal, distance_at(z, point, length(tangent)));
}

// The direction in which the height over the set grows fastest, not normalised; 0 inside.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    load_slots();
    let c = addend(fractal, point);
    let moved = initial_rows(point, POINT_ROWS);
    var z = initial(point);
    var unit = 1.0;
    var rows = moved;
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        let shrink = 1.0 / unit;
        let next = next_with_rows(
            n, z, c, point, 1.0, fractal.addend_derivative, rows,
            scaled_rows(moved, shrink * fractal.addend_derivative), scaled_rows(POINT_ROWS, shrink), vec3f(0.0));
        z = next.z;
        let all = max(max(abs(next.rows.x), abs(next.rows.y)), max(abs(next.rows.z), abs(next.rows.w)));
        let size = clamp(max(max(all.x, all.y), all.z), 1e-30, 1e30);
        unit = clamp(unit * size, 1e-30, 1e30);
        rows = scaled_rows(next.rows, 1.0 / size);
    }
    if (!(distance_at(z, point, 1.0) > 0.0)) { return vec3f(0.0); }
    return distance_slope(z, point, 1.0, rows, scaled_rows(POINT_ROWS, 1.0 / unit), vec3f(0.0));
}
