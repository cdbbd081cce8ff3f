// Series approximations: polynomials of the point's offset that replace the first steps of all orbits near
// the anchor. Host twin, with the equations: `deep/series.rs`.

// Radius of the first of `anchor_orbit.series`, in scales, and the ratio of each radius to the one before:
// `uniforms.rs`.
const FIRST_RADIUS = 12.0;
const RADII_RATIO = 8.0;

// Index of the series approximation for a point; `SERIES` if the point is outside all radii.
fn series_of(point: vec3f) -> u32 {
    let radii = log2(dot(point, point) / (FIRST_RADIUS * FIRST_RADIUS)) / (2.0 * log2(RADII_RATIO));
    return u32(clamp(ceil(radii), 0.0, f32(SERIES)));
}

// The state after the steps of a series approximation.
fn series_state(series: SeriesApproximation, reference: vec3f, point: vec3f) -> OrbitState {
    // A second-order polynomial's difference: the mean of its Jacobians at the anchor and at the point.
    let at_anchor = mat3x3f(series.along_x, series.along_y, series.along_z);
    let difference = 0.5 * ((at_anchor + series_jacobian(series, point)) * point);
    return OrbitState(reference + difference, series.steps, difference, series.steps);
}

// The state after the series approximation `which` of `anchor_orbit`.
fn far_state(which: u32, point: vec3f) -> OrbitState {
    let series = anchor_orbit.series[which];
    return series_state(series, anchor_orbit.points[series.steps].z, point);
}

// dr after the steps of a series approximation.
fn series_derivative(series: SeriesApproximation, point: vec3f) -> f32 {
    return series.derivative + dot(series.derivative_gradient, point);
}

// The Jacobian after the steps of a series approximation.
fn series_jacobian(series: SeriesApproximation, point: vec3f) -> mat3x3f {
    return mat3x3f(
        series.along_x + point.x * series.along_xx + point.y * series.along_xy + point.z * series.along_zx,
        series.along_y + point.y * series.along_yy + point.z * series.along_yz + point.x * series.along_xy,
        series.along_z + point.z * series.along_zz + point.x * series.along_zx + point.y * series.along_yz,
    );
}

// The derivatives after the steps of `series`; `which`: its index in `anchor_orbit`.
fn series_derivatives(
    fractal: Fractal, series: SeriesApproximation, point: vec3f, along: vec3f, which: u32,
) -> Derivatives {
    let jacobian = series_jacobian(series, point);
    let stretched = jacobian * along;
    let dg = length(jacobian * series.widest) / step_factor(fractal);
    let rest = series.rest / series.derivative;
    // Within the series' radius its Jacobian is nearly constant.
    return Derivatives(series_derivative(series, point), dg, stretched, rest, 0.0, 0.0);
}

// The tangent after the steps of a series approximation.
fn series_tangent(series: SeriesApproximation, orbit: Orbit, point: vec3f) -> Tangent {
    let inverse = 1.0 / series_derivative(series, point);
    return Tangent(
        inverse * series_jacobian(series, point),
        (inverse * inverse) * series.derivative_gradient,
        inverse * orbit.constant_derivative,
    );
}
