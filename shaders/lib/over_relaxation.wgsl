// Steps along a ray that are longer than the ball that is known to be empty, and taken back where
// the next ball doesn't meet it: over-relaxed sphere tracing (Keinert et al. 2014, section 4.1).

// How much longer, from power 4 on. At lower powers balls are less to be relied upon, and at power 2 steps
// are plain ones: longer ones passed a fold of the surface on one ray in a hundred.
const RELAXATION = 1.4;

struct OverRelaxation {
    // How much longer than its ball a step is, where the one before was not taken back.
    relaxation: f32,
    // The same for the next step.
    next: f32,
    // Radius of the last ball.
    ball: f32,
    // The step that was taken from its centre; 0 at a ray's start.
    step: f32,
}

fn over_relaxation(power: f32) -> OverRelaxation {
    let relaxation = mix(1.0, RELAXATION, saturate(0.5 * power - 1.0));
    return OverRelaxation(relaxation, relaxation, 0.0, 0.0);
}

// How far to go back where something may lie between the last ball and that of the point here:
// to the last one's edge. 0 where the two meet.
fn step_back(over: ptr<function, OverRelaxation>, ball: f32) -> f32 {
    let gap = (*over).step - (*over).ball;
    if (gap <= ball) { return 0.0; }
    // From there a plain step.
    *over = OverRelaxation((*over).relaxation, 1.0, 0.0, 0.0);
    return gap;
}

// The step from a point whose ball has this radius.
fn next_step(over: ptr<function, OverRelaxation>, ball: f32) -> f32 {
    let step = (*over).next * ball;
    *over = OverRelaxation((*over).relaxation, (*over).relaxation, ball, step);
    return step;
}

// What part of the estimate a step covers at least where so many of a ray's steps are spent:
// `fractal::march::step_escalation`.
fn step_escalation(spent: u32, most: u32) -> f32 {
    let part = f32(spent) / f32(most);
    return part * part * part * part;
}

// Where the estimate dips, a hit counts if it lasts: `THICK` hit distances on, and at the other places
// on the way there, the ray is still as near. What makes the others is far thinner than a pixel, and
// which of them a ray meets is chance.
const THICK = 0.5;
const THICK_PLACES = 6u;
// Halvings of the step that crossed the hit distance, so that the places lie where they should.
const HALVINGS = 5u;
const LOOKS = HALVINGS + THICK_PLACES;

// A hit that is looked at.
struct Crossing {
    // Depths before and behind it.
    outside: f32,
    inside: f32,
    // How many looks were taken, the one that found it among them. 0: none is looked at. More than
    // `LOOKS`: it lasts.
    looks: u32,
}

// After a look at depth `t`: where the next one goes, or, where the hit lasts, its depth.
fn next_look(crossing: ptr<function, Crossing>, before: f32, t: f32, hit: f32, is_near: bool) -> f32 {
    let looks = (*crossing).looks;
    if (looks == 0u) {
        *crossing = Crossing(before, t, 1u);
        return 0.5 * (before + t);
    }
    if (looks > HALVINGS) {
        (*crossing).looks = select(0u, looks + 1u, is_near);
        if (is_near && looks == LOOKS) { return (*crossing).inside; }
        return t + select(0.0, THICK / f32(THICK_PLACES) * hit, is_near);
    }
    if (is_near) { (*crossing).inside = t; } else { (*crossing).outside = t; }
    (*crossing).looks = looks + 1u;
    if (looks == HALVINGS) { return (*crossing).inside + THICK / f32(THICK_PLACES) * hit; }
    return 0.5 * ((*crossing).outside + (*crossing).inside);
}
