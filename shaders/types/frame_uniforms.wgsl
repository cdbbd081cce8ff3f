// The uniforms of a frame, for every pass. Host twin: `render::uniforms`.
// uses: formula_types, types/light_type

struct Camera {
    // The eye, in render space, as are all points and lengths without another unit: one unit is
    // `March.scale` scene units.
    origin: vec3f,
    // Half the picture's height at depth one.
    half_height: f32,
    // The camera's axes in world space.
    right: vec3f,
    // Width over height of the whole picture.
    aspect: f32,
    up: vec3f,
    // Hit distance per unit of depth.
    hit_cone: f32,
    forward: vec3f,
    // Distance from the surface at which colours are taken, per unit of depth along `forward`.
    color_cone: f32,
    // Radius of the aperture, in render space; 0 for a pinhole.
    lens_radius: f32,
    // Depth along `forward` at which the picture is sharp, in render space.
    focus: f32,
    // Number of the aperture's blades; below 3 the aperture is a circle.
    blades: u32,
}

// The range of rays, and how a ray steps: the formula's march policy.
struct March {
    // Origin and unit of render space, in scene units.
    anchor: vec3f,
    scale: f32,
    // Radius of a sphere about the scene's origin that holds what is drawn of the set, in scene units.
    bounding_radius: f32,
    // Radius, in scene units, of the sphere in which camera rays march that pass beside the bounding sphere: greater by
    // the hit distance, unless the bounding sphere cuts the set.
    radius_beside: f32,
    // Most steps of an orbit, of a camera ray and of a shadow ray.
    iterations: u32,
    march_steps: u32,
    shadow_steps: u32,
    // Least hit distance: f32 resolves no finer.
    finest_hit: f32,
    // Factor of over-relaxed steps.
    relaxation: f32,
    // Radius of the largest ball that a ray takes for empty, over the radius of the ball before.
    ball_growth: f32,
    // Radius of the ball that a cone treats as empty, over the safe step.
    ball_part: f32,
    // Number of a hit's checks that must be within the hit distance.
    near_checks: u32,
    // 1 if the estimate has false minima thinner than a pixel.
    checks_hits: u32,
    // Radius, per unit of distance to the point, of the cone about a shadow ray that a blocker has to fill.
    shadow_cone: f32,
    // Least clearance of an unblocked shadow ray, and its least step, in the point's hit distances.
    shadow_margin: f32,
    shadow_min_step: f32,
}

// Models of the surface: that of the thesis, and GGX lobes over a diffuse surface.
const SURFACE_BLINN_PHONG = 0u;
const SURFACE_PHYSICAL = 1u;

// Values that the second layer of colours drives, as bits.
const DRIVES_ROUGHNESS = 1u;
const DRIVES_METALNESS = 2u;
const DRIVES_COAT = 4u;
const DRIVES_EMISSION = 8u;

struct Surface {
    ambient: f32,
    // Of Blinn-Phong.
    diffuse: f32,
    specular: f32,
    shininess: f32,
    light_count: u32,
    // One of the `SURFACE_` constants.
    model: u32,
    // Of physical surfaces, 0 to 1.
    roughness: f32,
    metalness: f32,
    // Reflectance of what is not metal at normal incidence.
    specular_color: vec3f,
    // Part of the surface that is under a clear coat.
    coat: f32,
    coat_roughness: f32,
    // Emitted radiance over the surface's colour.
    emission: f32,
    // Bits of `DRIVES_`.
    driven: u32,
}

// The layer is not drawn.
const COLOR_NONE = 0u;
const COLOR_ITERATIONS = 1u;
const COLOR_CHANNEL = 2u;
const COLOR_POSITION = 3u;
const COLOR_NORMAL = 4u;
const COLOR_POINT_TRAP = 5u;
const COLOR_AXIS_TRAP = 6u;
const COLOR_PLANE_TRAP = 7u;
const COLOR_SPHERE_TRAP = 8u;
const COLOR_CUBE_TRAP = 9u;

// How one layer of colours selects positions in its gradient.
struct ColorLayer {
    // Centre of the orbit trap, in the formula's unit.
    center: vec3f,
    // One of the `COLOR_` constants.
    source: u32,
    // Direction of the axis, for sources that have one; a unit vector.
    axis: vec3f,
    // Size of the orbit trap.
    size: f32,
    // The greatest value that is told apart.
    greatest: f32,
    // Gradient lengths per unit of the value, and the offset into the gradient.
    repeats: f32,
    offset: f32,
    // 1: the colour curve replaces the value; then the value at its first knot, and one over its range.
    follows_view: u32,
    curve_low: f32,
    curve_per_value: f32,
    // Part of the layer in the colour, for the second one.
    amount: f32,
}

// The colour value of samples on section planes, in place of the second layer's.
const ON_SECTION = -1e30;

// Planes that cut the set open, and the colours of the cuts.
struct Sections {
    // The plane's normal, toward the side that is cut away, and its distance from the origin along the normal,
    // in render space.
    planes: array<vec4f, 3>,
    // Distance from the set within which each plane is drawn, in render space.
    band_reach: vec4f,
    // Colour of the set's inside, linear Rec. 709.
    inside: vec3f,
    count: u32,
    // Lengths of the first layer's gradient per iteration.
    repeats: f32,
}

struct Background {
    // Linear Rec. 709; w unused.
    top: vec4f,
    bottom: vec4f,
    // Axes of the environment map in world space: right, forward, up.
    map_x: vec3f,
    // Factor on the environment map; 0 shows the gradient instead.
    map_gain: f32,
    map_y: vec3f,
    map_z: vec3f,
    // Samples of a finished pixel if the background is transparent: it is black then, and samples that see it have no
    // weight on the film. 0: the background is shown.
    transparent_samples: f32,
}

// The set has a surface.
const MEDIUM_NONE = 0u;
// The set's inside is a medium.
const MEDIUM_SET = 1u;
// A medium about the set, as dense as iteration counts are high.
const MEDIUM_ITERATIONS = 2u;

// The medium in place of the set's surface, for paths.
struct Medium {
    // Single-scattering albedo, linear Rec. 709.
    color: vec3f,
    // One of the `MEDIUM_` constants.
    kind: u32,
    // At full density, in render space.
    mean_free_path: f32,
    // Mean cosine of scattering.
    anisotropy: f32,
    // Iteration count up to which the density is 0, and the rise of the density per iteration above.
    thin: f32,
    per_iteration: f32,
}

// Fog in a ball, thinner with the height.
struct Fog {
    // Single-scattering albedo, linear Rec. 709.
    color: vec3f,
    // Extinction coefficient at full density, per unit of render space; 0 without fog.
    density: f32,
    // The ball's centre in render space.
    center: vec3f,
    radius: f32,
    // Radiance of thick fog in direct light: that of all lights, without shadows.
    ambient: vec3f,
    // Mean cosine of scattering.
    anisotropy: f32,
    // Height over the centre up to which the density is full, in render space.
    level: f32,
    // One over the height in which the density falls by the factor e; 0 for the same density everywhere.
    inverse_height: f32,
}

struct Tone {
    // Factor on radiance.
    exposure: f32,
    // 1 / white point².
    inverse_white_squared: f32,
    curve: u32,
    // 1: Reinhard's curve on each channel; 0: on luminance.
    per_channel: u32,
    // 1: auto exposure brings the film's mean to the key.
    auto_exposure: u32,
    // 1: the mean is the mean of the logarithm.
    logarithmic: u32,
    // Luminance that auto exposure brings the mean to.
    key: f32,
    // 1: the display has 16 bits per channel, in two texels of each pixel.
    is_deep: u32,
}

struct Bloom {
    // Factor on the bloom that is added; 0 is off.
    strength: f32,
    // Half width of a single uniform kernel, over the picture's height.
    radius: f32,
    // Luminance above which light blooms.
    threshold: f32,
    // 1: bloom is added after the tone curve.
    after: u32,
    // Number of times that the kernel is applied.
    passes: u32,
}

// Path tracing.
struct PathTracing {
    // Most segments of a path between surfaces.
    bounces: u32,
    // Number of single lights: the first ones of the scene's lights.
    light_count: u32,
    // Which strategy gathers light: a `STRATEGY_` constant.
    strategy: u32,
    // Longest ray between two vertices, in render space.
    reach: f32,
    // The sun; black if there is none.
    sun: Light,
    // Axes of the sky in world space: right, forward, up.
    sky_x: vec3f,
    // Factor on the sky's radiance; 0 without a sky.
    sky_gain: f32,
    sky_y: vec3f,
    // Greatest distance of a surface that blocks the sky, in render space.
    sky_reach: f32,
    sky_z: vec3f,
    // Unnormalised selection probability of the sky: half its integrated luminance, over pi.
    sky_importance: f32,
    // Longest ray: also those toward lights that are blocked from farther away than the reach.
    ray_reach: f32,
    // Samples per pixel over which path tracing fades in; 0: no fade.
    preview_samples: f32,
    // Noise target: error at which pixels get no more samples; 0: none.
    noise: f32,
    // 1: displays show denoised light.
    denoise: u32,
    // Greatest luminance of a path; 0: no limit.
    firefly_limit: f32,
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
    // One of the `INDIRECT_` constants.
    kind: u32,
    // Radius of the neighbourhood of a sample, over the picture's height.
    radius: f32,
    strength: f32,
    ambient: f32,
    directions: u32,
    samples: u32,
    // Size of one eye's picture of the indirect source, in pixels.
    source_px: vec2u,
}

// The eyes that the region shows, for stereo pictures.
struct Eyes {
    // The first pixel of the second eye's part.
    second_at: vec2u,
    // 1 or 2.
    count: u32,
    // -1: the first eye is a left eye; 1: a right eye; 0: no stereo.
    first_side: f32,
    // Distance from the camera to either eye.
    half_separation: f32,
    // Half separation at depth one, by which an eye's picture moves back.
    half_shift: f32,
    // Size of an eye's picture over the whole film, across and down.
    share: vec2f,
    // Position of the first eye's picture on the whole film: 0 at the start, 1 at the end.
    first_place: f32,
    // 1: both eyes in one display picture, red and cyan.
    anaglyph: u32,
}

struct FrameUniforms {
    camera: Camera,
    eyes: Eyes,
    march: March,
    surface: Surface,
    first_layer: ColorLayer,
    second_layer: ColorLayer,
    sections: Sections,
    indirect: Indirect,
    background: Background,
    medium: Medium,
    fog: Fog,
    tone: Tone,
    bloom: Bloom,
    paths: PathTracing,
    // Size of one eye's whole picture, the region's corner in that picture, and the region's size with all
    // its eyes; in pixels.
    picture_px: vec2u,
    origin_px: vec2u,
    size_px: vec2u,
    // One of the `NORMALS_` constants.
    normals: u32,
    // The layers' colour curves: positions in the gradient at 64 knots each.
    color_curves: array<vec4f, 32>,
    // Declared by the formula.
    formula: FormulaUniforms,
}

@group(0) @binding(0) var<storage, read> frame_uniforms: FrameUniforms;

// `frame`, a copy of the members that a module's files name, and `read_frame` are generated (`render::shaders`). Every
// entry point begins with `read_frame()`, before any branch (docs/notes/marching.md, "Uniforms in each thread").
