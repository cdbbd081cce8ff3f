// Guides of the denoiser, one element a pixel: means over the first vertices of its paths.
// uses: lib/octahedral

// x: albedo, three 8-bit unsigned normalised numbers. y: normal, three 8-bit signed normalised numbers; shorter than 1 where
// normals differ, 0 in media and in the background. The high bytes hold the logarithm of the pixel's
// standard error, in 16 bits.
struct Guides {
    albedo: vec3f,
    normal: vec3f,
    // Standard error of the luminance over that of the albedo.
    error: f32,
}

// Steps of the error per factor of two, and the logarithm of the least error.
const ERROR_STEPS = 1024.0;
const LEAST_ERROR = -24.0;

fn pack_guides(guides: Guides) -> vec2u {
    let error = u32(clamp(ERROR_STEPS * (log2(max(guides.error, 1e-9)) - LEAST_ERROR), 0.0, 65535.0));
    let albedo = pack4x8unorm(vec4f(guides.albedo, 0.0));
    let normal = pack4x8snorm(vec4f(guides.normal, 0.0));
    return vec2u((albedo & 0xffffffu) | (error << 24u), (normal & 0xffffffu) | ((error >> 8u) << 24u));
}

fn unpack_guides(packed: vec2u) -> Guides {
    let steps = (packed.x >> 24u) | ((packed.y >> 24u) << 8u);
    let error = exp2(f32(steps) / ERROR_STEPS + LEAST_ERROR);
    return Guides(unpack4x8unorm(packed.x).xyz, unpack4x8snorm(packed.y).xyz, error);
}

// What light is divided by before it is filtered, so that the pattern of the albedo stays sharp.
fn demodulator(albedo: vec3f) -> vec3f {
    return max(albedo, vec3f(0.02));
}

// The guides of a single path, in 32 bits: albedo in five or six bits a channel, octahedral normal in eight bits a
// coordinate. 0 as `normal` stands for none.
fn pack_path_guides(albedo: vec3f, normal: vec3f) -> u32 {
    let steps = vec3u(round(saturate(albedo) * vec3f(31.0, 63.0, 31.0)));
    var direction = NO_DIRECTION;
    if (any(normal != vec3f(0.0))) { direction = pack4x8snorm(vec4f(octahedral_fold(normal), 0.0, 0.0)); }
    return steps.r | (steps.g << 5u) | (steps.b << 11u) | (direction << 16u);
}

// No pair of packed coordinates.
const NO_DIRECTION = 0x8080u;

fn unpack_path_guides(packed: u32) -> Guides {
    let steps = vec3u(packed, packed >> 5u, packed >> 11u) & vec3u(31u, 63u, 31u);
    var normal = vec3f(0.0);
    if (packed >> 16u != NO_DIRECTION) { normal = octahedral_unfold(unpack4x8snorm(packed >> 16u).xy); }
    return Guides(vec3f(steps) / vec3f(31.0, 63.0, 31.0), normal, 0.0);
}
