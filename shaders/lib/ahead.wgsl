// How marches ask for the reach: in their inner loops by `quick_reach`, and what it can't tell in outer
// ones, each of which the inner loop leaves for that and comes back from. Some drivers execute a loop's
// body once even if no thread enters it, and a march whose only loop asks `reach` takes twice as long on
// lavapipe.

// What a march knows of the point ahead.
struct Known {
    // The careful reach, where it is needed.
    reach: Reach,
    // Whether the inner loop has asked for it.
    is_needed: bool,
}

// The reach at the point ahead. Where `known` needs it afterwards, it means nothing, and `careful_reach`
// of the same point has to be put there.
fn reach_ahead(known: ptr<function, Known>, fractal: Fractal, point: vec3f, along: vec3f) -> Reach {
    var ahead = (*known).reach;
    if (!(*known).is_needed) { ahead = quick_reach(fractal, point, along); }
    (*known).is_needed = ahead.step < 0.0;
    return ahead;
}

fn careful_reach(fractal: Fractal, point: vec3f, along: vec3f) -> Reach {
    if (DEEP && !TURNS) { return reach(fractal, point, along); }
    return Reach(0.0, 0.0);
}
