// The uniforms of the Mandelbulb's kernels. Host twin: `uniforms.rs`.

struct Fractal {
    julia_constant: vec3f,
    power: f32,
    iterations: u32,
    // Radius beyond which an orbit is not followed, scene units.
    bailout: f32,
    // 1 for the Julia form.
    julia: u32,
    // Sign of the sine term.
    z_sign: f32,
    // Longest safe step of a ray.
    max_step: f32,
    // Derivatives are clamped to this so that the next step cannot overflow.
    derivative_max: f32,
    log2_bailout: f32,
    // Orbits whose dr falls below this, in units of 1 / scale, use the careful estimate.
    min_derivative: f32,
    // Origin and unit of render space, in scene units.
    anchor: vec3f,
    scale: f32,
    // Number of points of the reference orbit, number of the anchor's own points among them, and index of
    // the point from which orbits restart.
    reference_points: u32,
    own_points: u32,
    restart: u32,
    // Squared radius about the anchor within which orbits use the near steps; 0 if none do.
    near_radius_squared: f32,
    // Distance from the anchor beyond which plain f32 resolves points.
    far_radius: f32,
    // Natural logarithm of the radius from which orbits grow for certain.
    log_escape_radius: f32,
}

// Series approximation: second-order polynomials of the point's offset that replace the first steps of
// all orbits near the anchor. Host twin, with the equations: `deep/series.rs`.
struct SeriesApproximation {
    // First derivatives of the difference, then its second derivatives.
    along_x: vec3f,
    // Number of steps replaced.
    steps: u32,
    along_y: vec3f,
    // dr at the anchor, in units of 1 / scale.
    derivative: f32,
    along_z: vec3f,
    along_xx: vec3f,
    along_yy: vec3f,
    along_zz: vec3f,
    along_xy: vec3f,
    along_yz: vec3f,
    along_zx: vec3f,
    derivative_gradient: vec3f,
    // The direction that the replaced steps stretch most, a unit vector.
    widest: vec3f,
    // Stretch across `widest`: the root of the mean square.
    rest: f32,
    // Least distances of the replaced steps, without the first point, from the colour layers' traps.
    traps: vec2f,
}

// Number of series approximations. The first holds within `FIRST_RADIUS` scales, each other one within
// `RADII_RATIO` times the radius before.
const SERIES = 8u;

// Most points of a reference orbit; with `series` they fit into a uniform buffer of 64 KiB.
const MAX_REFERENCE_POINTS = 1984u;

// A point of the reference orbit.
struct ReferencePoint {
    z: vec3f,
    // |x + iy|.
    rho: f32,
    // (x + iy) / rho; 1 on the axis.
    rotor: vec2f,
}

// Most near steps, and the number of their reference points.
const MAX_NEAR_STEPS = 8u;

const NEAR_POINTS = MAX_NEAR_STEPS + 1u;

// The reference orbit and the series approximations.
struct AnchorOrbit {
    series: array<SeriesApproximation, SERIES>,
    // The anchor's orbit; for the Julia form the orbit of the constant follows.
    points: array<ReferencePoint, MAX_REFERENCE_POINTS>,
}

// The formula's part of a frame's uniforms.
struct FormulaUniforms {
    fractal: Fractal,
    // The series approximation before the near steps, and the near steps' reference points.
    series: SeriesApproximation,
    near: array<ReferencePoint, NEAR_POINTS>,
    // The direction that orbits in view stretch most, a unit vector: it stands for all directions of a cone.
    cone_direction: vec3f,
}

// A uniform buffer, not a storage buffer: lavapipe gathers points that differ between lanes several times
// as fast from it; from a storage buffer it reads each lane's words one by one, in a loop.
@group(0) @binding(1) var<uniform> anchor_orbit: AnchorOrbit;
