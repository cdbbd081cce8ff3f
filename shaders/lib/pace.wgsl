// Steps along a ray that are longer than the ball that is known to be empty, and taken back where
// the next ball doesn't meet it: over-relaxed sphere tracing (Keinert et al. 2014, section 4.1).

// How much longer.
const RELAXATION = 1.4;

struct Pace {
    // Radius of the last ball.
    ball: f32,
    // The step that was taken from its centre; 0 at a ray's start.
    step: f32,
    relaxation: f32,
}

fn paced() -> Pace {
    return Pace(0.0, 0.0, RELAXATION);
}

// How far to go back where something may lie between the last ball and that of the point here:
// to the last one's edge. 0 where the two meet.
fn step_back(pace: ptr<function, Pace>, ball: f32) -> f32 {
    let gap = (*pace).step - (*pace).ball;
    if (gap <= ball) { return 0.0; }
    // From there a plain step.
    *pace = Pace(0.0, 0.0, 1.0);
    return gap;
}

// The step from a point whose ball has this radius.
fn next_step(pace: ptr<function, Pace>, ball: f32) -> f32 {
    let step = (*pace).relaxation * ball;
    *pace = Pace(ball, step, RELAXATION);
    return step;
}
