// What every pass knows of the picture. Host twin: `render::uniforms`.

struct Camera {
    // The eye, in the view's unit, as all points and lengths are that say nothing else: the scene's
    // own, or `Fractal.scale` of those.
    origin: vec3f,
    // Half the picture's height at depth one.
    half_height: f32,
    // The camera's axes in world space.
    right: vec3f,
    // Width over height of the whole picture.
    aspect: f32,
    up: vec3f,
    // Hit distance at depth one.
    hit_cone: f32,
    forward: vec3f,
    unused: u32,
}

struct Fractal {
    julia_constant: vec3f,
    power: f32,
    iterations: u32,
    // In scene units, and so is the next.
    bailout: f32,
    // Nothing of the set lies outside this sphere about the scene's origin.
    bounding_radius: f32,
    // 1 for the Julia form.
    julia: u32,
    // Sign of the sine term.
    z_sign: f32,
    // No step is longer than this.
    max_step: f32,
    // Derivatives are cut off here so that the next step cannot overflow.
    derivative_max: f32,
    // Most steps of a camera ray and of a shadow ray.
    march_steps: u32,
    shadow_steps: u32,
    // Hit distances never go below this: f32 resolves no finer.
    finest_hit: f32,
    log2_bailout: f32,
    // Orbits whose derivative falls below this, in units of one over the scale, need `reach`.
    least_derivative: f32,
    // Where the coordinates of all points begin, in scene units, and their unit in those.
    anchor: vec3f,
    scale: f32,
    // Of views that are drawn from an anchor: how many places the reference has, how many of them are
    // the anchor's own orbit, and which of them orbits start anew from.
    reference_points: u32,
    own_points: u32,
    restart: u32,
    // 1 where orbits are followed in frames that turn with their points' longitudes.
    rotates: u32,
    // Within which radius of the anchor, squared, orbits take the near steps; 0 where none do.
    near_radius_squared: f32,
    // Beyond which distance from the anchor plain f32 tells points apart.
    far_radius: f32,
    // How many near steps there are, and 1 where `FrameUniforms.series` stands for the steps before those.
    near_steps: u32,
    has_series: u32,
}

// Series approximation: the first steps of all orbits near the anchor, as second-order polynomials of
// the point's offset. Host twin, with the equations: `fractal::deep::series`.
struct SeriesApproximation {
    // First derivatives of the difference, then second ones.
    along_x: vec3f,
    // How many steps.
    steps: u32,
    along_y: vec3f,
    // dr at the anchor, in units of 1 / scale.
    derivative: f32,
    along_z: vec3f,
    unused: u32,
    along_xx: vec3f,
    unused_a: u32,
    along_yy: vec3f,
    unused_b: u32,
    along_zz: vec3f,
    unused_c: u32,
    along_xy: vec3f,
    unused_d: u32,
    along_yz: vec3f,
    unused_e: u32,
    along_zx: vec3f,
    unused_f: u32,
    derivative_gradient: vec3f,
    unused_g: u32,
    // Squares of the least distances of the points passed, after the first, from the origin, the z
    // axis and the plane z = 0.
    traps_squared: vec3f,
    unused_h: u32,
    // The direction that those steps stretch most, a unit vector.
    widest: vec3f,
    // How far they stretch what is across it: the root of the mean square.
    rest: f32,
}

// How many there are, for points within radii of which each is `RADII_RATIO` times the last one, the
// first `FIRST_RADIUS` scales.
const SERIES = 8u;

// Most points of a reference orbit; with `series` they fit into a uniform buffer of 64 KiB.
const MOST_REFERENCE_POINTS = 1984u;

// A place of the anchor's orbit.
struct ReferencePoint {
    z: vec3f,
    // |x + iy|.
    rho: f32,
    // (x + iy) / rho; 1 on the axis.
    rotor: vec2f,
    unused: vec2u,
}

struct Surface {
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    color_source: u32,
    color_repeats: f32,
    color_offset: f32,
    light_count: u32,
}

struct Background {
    // Linear Rec. 709; w unused.
    top: vec4f,
    bottom: vec4f,
    // Axes of the environment map in world space: right, ahead, up.
    picture_x: vec3f,
    // Factor on the picture; 0 where the gradient is shown in its place.
    picture_gain: f32,
    picture_y: vec3f,
    unused_a: u32,
    picture_z: vec3f,
    unused_b: u32,
}

struct Tone {
    // Factor on radiance.
    exposure: f32,
    // 1 / white point².
    inverse_white_squared: f32,
    curve: u32,
    // 1: Reinhard's curve on each channel; 0: on luminance.
    per_channel: u32,
    // 1: the film's mean is brought to the key.
    auto_exposure: u32,
    // 1: by the mean of the logarithm.
    logarithmic: u32,
    // What the mean is brought to.
    key: f32,
    unused: u32,
}

struct Bloom {
    // Part of the spread light that is added; 0 is off.
    strength: f32,
    // Half width of a single uniform kernel, as a part of the picture's height.
    radius: f32,
    // Luminance above which light spreads.
    threshold: f32,
    // 1: after the tone curve.
    after: u32,
    // How often the kernel is applied.
    passes: u32,
    unused_a: u32,
    unused_b: u32,
    unused_c: u32,
}

const NORMALS_NONE = 0u;
const NORMALS_THREE = 1u;
const NORMALS_SIX = 2u;
const NORMALS_EIGHTEEN = 3u;
const NORMALS_TWENTY_SIX = 4u;
const NORMALS_ANALYTIC = 5u;

const INDIRECT_OFF = 0u;
const INDIRECT_UNIFORM = 1u;
const INDIRECT_HORIZON = 2u;

struct Indirect {
    // One of the above.
    kind: u32,
    // How far around a sample it looks, as a part of the picture's height.
    radius: f32,
    strength: f32,
    ambient: f32,
    directions: u32,
    samples: u32,
    // One eye's picture that the neighbours are from, in pixels.
    source_px: vec2u,
}

// Which eyes the region shows, for a picture in stereo.
struct Eyes {
    // The first pixel of the second eye's part.
    second_at: vec2u,
    // 1 or 2.
    count: u32,
    // -1: the first is a left eye; 1: a right one; 0: there is only the camera.
    first_side: f32,
    // From the camera to either eye.
    half_separation: f32,
    // The same at depth one, by which an eye's picture is moved back.
    half_shift: f32,
    // The part of the whole film that an eye's picture has, across and down.
    share: vec2f,
    // Where the first eye's part of it lies: 0 at its beginning, 1 at its end.
    first_place: f32,
    // 1: both eyes in one display picture, red and cyan.
    anaglyph: u32,
    unused: vec2u,
}

// Most steps that all orbits near the anchor take together, and the places that they pass.
const MOST_NEAR_STEPS = 8u;
const NEAR_POINTS = MOST_NEAR_STEPS + 1u;

struct FrameUniforms {
    camera: Camera,
    eyes: Eyes,
    fractal: Fractal,
    surface: Surface,
    indirect: Indirect,
    background: Background,
    tone: Tone,
    bloom: Bloom,
    // One eye's whole picture and the region's corner in it, then the region with all its eyes,
    // in pixels.
    picture_px: vec2u,
    origin_px: vec2u,
    size_px: vec2u,
    // How normals are found.
    normals: u32,
    unused: u32,
    // The series approximation before the near steps, and the reference points of these.
    series: SeriesApproximation,
    near: array<ReferencePoint, NEAR_POINTS>,
}

// What of the anchor's orbit the picture itself does not hold.
struct AnchorOrbit {
    series: array<SeriesApproximation, SERIES>,
    // For the Julia form the orbit of its constant is behind the anchor's.
    points: array<ReferencePoint, MOST_REFERENCE_POINTS>,
}

@group(0) @binding(0) var<storage, read> frame_uniforms: FrameUniforms;
// Lanes that read places of their own gather them from a uniform buffer several times as fast on lavapipe:
// of a storage buffer it reads each lane's words one by one, in a loop.
@group(0) @binding(1) var<uniform> anchor_orbit: AnchorOrbit;

// Every entry point begins with `frame = frame_uniforms`. Where all threads are still together,
// lavapipe reads a value once for all of them; past any branch, once for each, and again for each
// use in a loop.
var<private> frame: FrameUniforms;
