// Auto exposure: computes, from the last mip level `dispatch.mip_level`, the stops that bring the mean to
// the key (Reinhard et al. 2002, eq. 2). Level 0 reuses the mean in the statistics.
// uses: lib/luminance, lib/mip, types/dispatch_params, types/frame_uniforms, types/post

// Limit of auto exposure, stops: for a black film and for a very bright one.
const MAX_STOPS = 20.0;

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) local_index: u32) {
    read_frame();
    if (local_index != 0u) { return; }
    if (dispatch.mip_level != 0u) {
        // The last level has one element per eye.
        let levels = film_levels();
        let first = mip_start(levels, dispatch.mip_level);
        let all = 0.5 * (mips[first] + mips[first + levels.eyes.x * levels.eyes.y - 1u]);
        statistics.mean = all.rgb;
        statistics.mean_log2 = all.w;
    }
    let arithmetic = log2(max(luminance(statistics.mean), 1e-12));
    let mean_stops = select(arithmetic, statistics.mean_log2, frame.tone.logarithmic != 0u);
    let goal = clamp(log2(frame.tone.key) - mean_stops, -MAX_STOPS, MAX_STOPS);
    // At the end the exact goal, without rounding.
    let nearer = mix(statistics.adapted_stops, goal, dispatch.adapt);
    statistics.adapted_stops = select(nearer, goal, dispatch.adapt >= 1.0);
}
