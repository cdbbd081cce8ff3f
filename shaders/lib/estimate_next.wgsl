// Estimates of a march: the inner loop computes `quick_estimate` and breaks if that is not exact enough,
// the outer loop computes `careful_estimate` and re-enters. lavapipe executes a loop's body even if no lane
// enters the loop: with the careful estimate in the inner loop a march takes twice as long.
// uses: formula, types/frame_uniforms

// A careful estimate for the next point of a march.
struct PendingEstimate {
    // Valid once `is_needed` is set and the outer loop has stored the estimate.
    estimate: Estimate,
    // True if the inner loop broke for a careful estimate.
    is_needed: bool,
}

// The estimate at the next point; invalid if the call sets `pending.is_needed`. The caller then stores
// `careful_estimate` of the same point in `pending` and calls again.
fn estimate_next(
    pending: ptr<function, PendingEstimate>, fractal: Fractal, point: vec3f, along: vec3f,
) -> Estimate {
    var ahead = (*pending).estimate;
    if (!(*pending).is_needed) { ahead = quick_estimate(fractal, point, along); }
    (*pending).is_needed = ahead.step < 0.0;
    return ahead;
}
