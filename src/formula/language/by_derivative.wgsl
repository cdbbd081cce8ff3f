// Estimates and gradients of a text that gives its running derivative, dr. From `operations.rs`, besides those of `orbit`:
//     next_with_rows                           a step with the derivatives of state and dr
//     distance_at, distance_slope              the estimate at an orbit's end, and its derivatives

fn estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    load_slots();
    let c = addend(fractal, point);
    var z = initial(point);
    var dr = fractal.initial_derivative;
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        let next = next_with_derivative(n, z, c, point, min(dr, MAX_DERIVATIVE), fractal.addend_derivative);
        z = next.z;
        dr = next.dr;
    }
    return estimate_of(fractal, distance_at(z, point, dr));
}

// The direction in which `distance_estimate` grows fastest, not normalised; 0 inside.
// The state's derivatives grow as dr, and those of dr as its square: both are kept over dr.
fn distance_gradient(fractal: Fractal, point: vec3f) -> vec3f {
    load_slots();
    let c = addend(fractal, point);
    let moved = initial_rows(point, POINT_ROWS);
    var z = initial(point);
    var dr = fractal.initial_derivative;
    var unit = max(dr, 1e-30);
    var rows = scaled_rows(moved, 1.0 / unit);
    // The gradient of dr, over the square of `unit`.
    var slope = vec3f(0.0);
    for (var n = 0u; n < fractal.iterations && !is_escaped(fractal, z); n++) {
        let shrink = 1.0 / unit;
        let next = next_with_rows(
            n, z, c, point, dr, fractal.addend_derivative, rows,
            scaled_rows(moved, shrink * fractal.addend_derivative), scaled_rows(POINT_ROWS, shrink), unit * slope);
        z = next.z;
        dr = min(next.dr, MAX_DERIVATIVE);
        let kept = unit / max(abs(dr), 1e-30);
        unit = max(abs(dr), 1e-30);
        rows = scaled_rows(next.rows, kept);
        slope = (kept / unit) * next.slope;
    }
    if (!(distance_at(z, point, dr) > 0.0)) { return vec3f(0.0); }
    return unit * distance_slope(z, point, dr, rows, scaled_rows(POINT_ROWS, 1.0 / unit), unit * slope);
}
