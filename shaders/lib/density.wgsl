// The density of the set's medium.
// uses: formula, types/frame_uniforms

// Whether rays outside the set pass no medium.
fn is_empty_outside() -> bool {
    return frame.medium.kind == MEDIUM_SET;
}

// Density over full density, 0 to 1.
fn medium_density(fractal: Fractal, point: vec3f) -> f32 {
    let orbit = orbit_colors(fractal, point);
    if (orbit.is_inside) { return 1.0; }
    if (is_empty_outside()) { return 0.0; }
    return saturate((orbit.smooth_iterations - frame.medium.thin) * frame.medium.per_iteration);
}
