// How far all rays of a cone may go at once: one march with the cone's width replaces the same first
// steps of each ray. The empty ball that a safe step guarantees about a point of the axis must contain
// the cone's whole width (cone marching: Seven, "Fast realistic ray marching"; here with balls
// instead of steps).
// uses: formula, lib/estimate_next, types/estimate, types/frame_uniforms

// Steps after which a cone that creeps along a surface stops and leaves the rest to its rays.
const CONE_STEPS = 48u;

// Greatest radius of a ball, so that an f32 holds its square.
const MAX_BALL = 1e18;

// Distance that the rays from `origin` may go before any of them comes within its hit distance.
// The rays' unit directions differ from `axis` by at most `spread`, as the length of the difference. They are
// known to be clear up to `start`. Each ray finds its own end.
fn clear_cone(
    fractal: Fractal, origin: vec3f, axis: vec3f, spread: f32, start: f32, hit_cone: f32,
) -> f32 {
    // The part of a safe step that is an empty ball: a step by the Jacobian holds near one point and direction only.
    let part = frame.march.ball_part;
    var t = start;
    var i = 0u;
    var pending = PendingEstimate(Estimate(0.0, 0.0), false);
    for (; ; ) {
        for (; i < CONE_STEPS; i++) {
            let ahead = estimate_next(&pending, fractal, origin + t * axis, cone_direction());
            if (pending.is_needed) { break; }
            let part_here = select(part, min(part, STEP_FROM_EYE), t == 0.0);
            let ball = min(part_here * ahead.step, MAX_BALL) - hit_cone * t;
            let width = t * spread;
            if (ball <= width) { break; }
            // Points of the cone at a distance of t + advance from the origin are in the ball:
            //     advance^2 + t (t + advance) spread^2 <= ball^2
            let lag = 0.5 * width * spread;
            let advance = sqrt(max(lag * lag + ball * ball - width * width, 0.0)) - lag;
            // Single rays are faster from here on.
            if (advance <= width) { break; }
            t += advance;
        }
        if (!pending.is_needed) { break; }
        pending.estimate = careful_estimate(fractal, origin + t * axis, cone_direction());
    }
    return t;
}
