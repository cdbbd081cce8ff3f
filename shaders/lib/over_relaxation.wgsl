// Over-relaxed sphere tracing (Keinert et al. 2014, section 4.1): steps along a ray longer than the
// empty ball, taken back if the next ball does not overlap the last one.
// uses: types/estimate, types/frame_uniforms

struct OverRelaxation {
    // Step over ball radius, after a step that was not taken back.
    relaxation: f32,
    // Step over ball radius for the next step.
    next: f32,
    // Radius of the last ball.
    ball: f32,
    // The step from the centre of the last ball; 0 at a ray's start.
    step: f32,
    // Radius of the largest ball that counts as empty at the next point.
    max_ball: f32,
}

// `OverRelaxation.max_ball` at a ray's first point.
const UNLIMITED_BALL = 1e30;

fn over_relaxation() -> OverRelaxation {
    let relaxation = frame.march.relaxation;
    return OverRelaxation(relaxation, relaxation, 0.0, 0.0, UNLIMITED_BALL);
}

// Radius of the ball that a ray takes for empty at a point with the estimate `ahead`, after `spent` of `most` steps.
fn empty_ball(over: OverRelaxation, ahead: Estimate, spent: u32, most: u32) -> f32 {
    // See `formula::march::step_escalation`.
    let distance = min(ahead.distance, frame.march.bounding_radius / frame.march.scale);
    return min(max(ahead.step, step_escalation(spent, most) * distance), over.max_ball);
}

// How far to step back: to the edge of the last ball if the ball here does not overlap it, since the gap
// may hold a surface; else 0.
fn step_back(over: ptr<function, OverRelaxation>, ball: f32) -> f32 {
    let gap = (*over).step - (*over).ball;
    if (gap <= ball) { return 0.0; }
    // The next step is a plain one.
    *over = OverRelaxation((*over).relaxation, 1.0, 0.0, 0.0, (*over).max_ball);
    return gap;
}

// The next step, from a point whose empty ball has radius `ball`.
fn next_step(over: ptr<function, OverRelaxation>, ball: f32) -> f32 {
    let step = (*over).next * ball;
    *over = OverRelaxation((*over).relaxation, (*over).relaxation, ball, step, frame.march.ball_growth * ball);
    return step;
}

// Least step over the estimate, or over the bounding radius if that is less, after `spent` of `most` steps:
// `formula::march::step_escalation`. Where hits need only some of the checks, rays hit in dust before they run out of steps:
// their late steps grow by the eighth power instead of the fourth, and pass fewer layers.
fn step_escalation(spent: u32, most: u32) -> f32 {
    let part = f32(spent) / f32(most);
    let fourth = part * part * part * part;
    let hits_in_dust = needs_hit_check() && frame.march.near_checks < THICKNESS_CHECKS;
    return select(fourth, fourth * fourth, hits_in_dust);
}

// Hits are checked if the estimate has false minima: a hit counts if the ray is within the hit distance at `near_checks` of
// `THICKNESS_CHECKS` points along `CHECKED_THICKNESS` hit distances. False minima are far thinner than a pixel, and which
// of them a ray meets is chance.
const CHECKED_THICKNESS = 0.5;
const THICKNESS_CHECKS = 6u;
// Halvings of the step that crossed the hit distance, so that the checked length starts at the crossing.
const HALVINGS = 5u;

// A hit that is being checked.
struct Crossing {
    // Depths before and after the crossing.
    outside: f32,
    inside: f32,
    // Number of looks taken, with the one that found the crossing. 0: no hit is being checked.
    looks: u32,
    // Number of checks within the hit distance. `March.near_checks`: the hit counts.
    near_checks: u32,
}

// After a look at depth `t`: the depth of the next look, or of the hit if the hit counts.
fn next_look(crossing: ptr<function, Crossing>, before: f32, t: f32, hit: f32, is_near: bool) -> f32 {
    let between = CHECKED_THICKNESS / f32(THICKNESS_CHECKS) * hit;
    let looks = (*crossing).looks;
    if (looks == 0u) {
        *crossing = Crossing(before, t, 1u, 0u);
        return 0.5 * (before + t);
    }
    if (looks > HALVINGS) {
        (*crossing).near_checks += select(0u, 1u, is_near);
        let near_checks = (*crossing).near_checks;
        if (near_checks == frame.march.near_checks) { return (*crossing).inside; }
        let fails = looks - HALVINGS - near_checks > THICKNESS_CHECKS - frame.march.near_checks;
        (*crossing).looks = select(looks + 1u, 0u, fails);
        return t + select(between, 0.0, fails);
    }
    if (is_near) { (*crossing).inside = t; } else { (*crossing).outside = t; }
    (*crossing).looks = looks + 1u;
    if (looks == HALVINGS) { return (*crossing).inside + between; }
    return 0.5 * ((*crossing).outside + (*crossing).inside);
}
