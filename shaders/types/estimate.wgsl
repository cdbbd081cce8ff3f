// The results of a formula's kernels at a point.
// uses: types/frame_uniforms

struct Estimate {
    // Estimated distance to the set; 0 inside.
    distance: f32,
    // Longest safe step of a ray, at most `distance`. Negative if a quick estimate is not exact
    // enough: the caller then needs the careful estimate.
    step: f32,
}

// Greatest part of the safe step that a camera ray or its cone takes from an eye inside the bounding sphere: the safe step
// there was up to about twice the way to the surface in random views.
const STEP_FROM_EYE = 0.3;

struct OrbitColors {
    // Thesis eq. 3.1 for any power and bailout: N - log_n(ln r / ln bailout).
    smooth_iterations: f32,
    // Whether the set holds the point.
    is_inside: bool,
    // The formula's own channel, folds for instance, on average over the steps; 0 if it has none.
    channel: f32,
    // Least distances of the orbit, after its start, from the colour layers' traps; at most `MAX_TRAP`.
    traps: vec2f,
}

// Whether the formula's estimate has false minima: 0 no, 1 yes, -1 reads it from the uniforms.
override CHECKS_HITS: i32 = -1;

fn needs_hit_check() -> bool {
    if (CHECKS_HITS >= 0) { return CHECKS_HITS == 1; }
    return frame.march.checks_hits != 0u;
}
