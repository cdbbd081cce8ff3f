// Plain steps: orbits in f32 about the scene's origin.

const MIXES_STEPS = false;

// A product of bounds on the stretch sets a ray's step.
const FOLLOWS_DIRECTION = false;

// True if the set may have seams, along which powers that are not whole tear it.
override HAS_SEAM: bool = POWER == 0u;

// Offset of orbits from the polar axis, where the longitude is undefined: toward +x, since
// atan2(0, 0) = 0, and off the plane y = 0, in which a step could still meet the axis.
const BESIDE_AXIS = vec3f(1e-9, 1e-16, 0.0);

struct OrbitState {
    z: vec3f,
    // Number of steps taken.
    count: u32,
}

// An orbit in progress.
struct Walk {
    state: OrbitState,
    // Squares of the state's z.
    q: Squares,
    gathered: Gathered,
}

fn orbit_of(fractal: Fractal, point: vec3f) -> Orbit {
    let julia = fractal.julia != 0u;
    return Orbit(
        point + BESIDE_AXIS,
        select(point, fractal.julia_constant, julia) + BESIDE_AXIS,
        vec3f(0.0),
        select(1.0, 0.0, julia),
        1.0,
        fractal.bailout * fractal.bailout,
    );
}

fn rho_of(z: vec3f, q: Squares) -> f32 {
    return sqrt(q.a);
}

fn begin_walk(gathers: u32, fractal: Fractal, orbit: Orbit, point: vec3f, along: vec3f) -> Walk {
    return Walk(OrbitState(orbit.start, 0u), squares(orbit.start), initial_gathered(fractal, orbit, along));
}

fn is_perturbed(fractal: Fractal, walk: Walk) -> bool {
    return false;
}

fn perturbed_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    return walk;
}

fn plain_step(gathers: u32, fractal: Fractal, orbit: Orbit, along: vec3f, walk: Walk) -> Walk {
    let before = walk.state;
    let step = raised(fractal, before.z, walk.q);
    let z = step.power + orbit.constant;
    let q = squares(z);
    let after = gathered(gathers, fractal, orbit, along, walk.gathered, step, before.z, walk.q, z);
    return Walk(OrbitState(z, before.count + 1u), q, after);
}

fn end_estimate(fractal: Fractal, walk: Walk) -> Estimate {
    return estimate_at(fractal, walk.gathered.derivatives, walk.q);
}

fn end_gradient(fractal: Fractal, walk: Walk) -> vec3f {
    return gradient_at(fractal, walk.state.z, walk.q, walk.gathered.tangent.jacobian, walk.gathered.tangent.slope);
}

fn end_traps(walk: Walk) -> vec2f {
    return walk.gathered.traps;
}

// The quick estimate is exact.
fn quick_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return estimate(fractal, point, along);
}

// Never called: the quick estimate is exact.
fn careful_estimate(fractal: Fractal, point: vec3f, along: vec3f) -> Estimate {
    return Estimate(0.0, 0.0);
}

// The direction that stands for all rays of a cone: zero, since there is none. Seams then limit steps in every direction,
// and cones take a part of a step, since no stretch along a ray limits it.
fn cone_direction() -> vec3f {
    return vec3f(0.0);
}
