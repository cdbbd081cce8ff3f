// Estimates and gradients of a text that gives no running derivative: the orbit's whole Jacobian is carried along.
// One direction would not do: where an orbit stretches across it, the estimate would be too long, and cones and rays
// would pass the surface. From `operations.rs`, besides those of `orbit`:
//     initial_rows, next_with_rows     the state with its derivatives, at the start and after a step
//     distance_at, distance_slope      the estimate at an orbit's end, and its derivatives

// Largest entry of a Jacobian, so that an f32 holds its square.
const MAX_ENTRY = 1e18;

fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    load_slots();
    let c = addend(fractal, point);
    let moved = initial_rows(point, POINT_ROWS);
    let addend_moved = scaled_rows(moved, fractal.addend_derivative);
    var z = initial(point);
    var rows = moved;
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        let next = next_with_rows(
            n, z, c, point, 1.0, fractal.addend_derivative, rows, addend_moved, POINT_ROWS, vec3f(0.0));
        z = next.z;
        rows = clamped_rows(next.rows);
    }
    return estimate_of(fractal, distance_at(z, point, frobenius_norm(rows)));
}

// Derivatives before a step, which must not overflow.
fn clamped_rows(rows: Rows) -> Rows {
    let most = vec3f(MAX_ENTRY);
    return Rows(
        clamp(rows.x, -most, most), clamp(rows.y, -most, most), clamp(rows.z, -most, most), clamp(rows.w, -most, most));
}

// At least the factor by which the orbit stretches any direction.
fn frobenius_norm(rows: Rows) -> f32 {
    return sqrt(dot(rows.x, rows.x) + dot(rows.y, rows.y) + dot(rows.z, rows.z) + dot(rows.w, rows.w));
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
