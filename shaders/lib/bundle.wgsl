// How far all rays of a bundle may go at once: one march with the bundle's own width spares each
// of them the same first steps. The ball about a point of the axis that a ray's safe step promises
// to be empty has to hold the bundle's whole width (cone marching, as of Seven, "Fast realistic
// ray marching"; here with balls rather than steps alone).

// The part of a safe step that is taken for an empty ball in all directions: a ray relies on it in one
// direction only. At low powers less.
fn ball_part(power: f32) -> f32 {
    return clamp(0.25 * power - 0.5, 0.7, 1.0);
}

// Steps after which a bundle that creeps along a surface leaves the rest to its rays.
const BUNDLE_STEPS = 48u;

// No ball is taken for larger, so that an f32 holds its square.
const MOST_BALL = 1e18;

// How far the rays from `origin` whose directions differ from `axis` by `spread` at most (the length of the
// difference of unit vectors) may go, from a distance that is known to be clear, before any of
// them is as near to the surface as `hit_cone` says: where a ray ends is up to the ray alone.
fn clear_cone(
    fractal: Fractal, origin: vec3f, axis: vec3f, spread: f32, start: f32, hit_cone: f32,
) -> f32 {
    let part = ball_part(fractal.power);
    var t = start;
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < BUNDLE_STEPS; i++) {
            let ahead = estimate_next(&pending, fractal, origin + t * axis, frame.series.widest);
            if (pending.is_needed) { break; }
            let ball = min(part * ahead.step, MOST_BALL) - hit_cone * t;
            let width = t * spread;
            if (ball <= width) { break; }
            // Points of the cone as far from the origin as t + advance are in the ball:
            //     advance^2 + t (t + advance) spread^2 <= ball^2
            let lag = 0.5 * width * spread;
            let advance = sqrt(max(lag * lag + ball * ball - width * width, 0.0)) - lag;
            // Single rays are quicker from here on.
            if (advance <= width) { break; }
            t += advance;
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, origin + t * axis, frame.series.widest);
    }
    return t;
}
