// The tone curves: from linear radiance to linear display values, 0 to 1.
// uses: lib/luminance, types/frame_uniforms

const CURVE_REINHARD = 1u;
const CURVE_ACES = 2u;
const CURVE_AGX = 3u;
const CURVE_KHRONOS_NEUTRAL = 4u;

// The curve that this pipeline is specialised for; -1 reads the curve from the uniforms.
override CURVE: i32 = -1;

fn tone_curve() -> u32 {
    if (CURVE >= 0) { return u32(CURVE); }
    return frame.tone.curve;
}

// Reinhard et al. 2002, eq. 4: on luminance, which keeps the hue, or on each channel.
fn reinhard(color: vec3f) -> vec3f {
    let by = select(vec3f(luminance(color)), color, frame.tone.per_channel != 0u);
    return color * ((1.0 + by * frame.tone.inverse_white_squared) / (1.0 + by));
}

// Stephen Hill's fit of the ACES reference rendering and sRGB output transforms. Exposed by
// 1/0.6 first, as is usual; else the curve is darker than the other curves.
fn aces(color: vec3f) -> vec3f {
    let to_working = mat3x3f(
        vec3f(0.59719, 0.07600, 0.02840), vec3f(0.35458, 0.90834, 0.13383), vec3f(0.04823, 0.01566, 0.83777));
    let from_working = mat3x3f(
        vec3f(1.60475, -0.10208, -0.00327), vec3f(-0.53108, 1.10813, -0.07276), vec3f(-0.07367, -0.00605, 1.07602));
    // Larger values are white; the limit keeps squares finite.
    let v = to_working * min(color / 0.6, vec3f(1e6));
    let fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return from_working * fitted;
}

// AgX after Troy Sobotka: the primaries move a fifth of their distance toward white (inset), the
// logarithm from 10 stops below middle grey to 6.5 above passes through a sigmoid, and the primaries
// move back (outset). The sigmoid has slope 2 at middle grey, which maps to 1/2; it reaches 0
// and 1 at the ends, with the powers 3 below and 3.25 above middle grey.
const AGX_INSET = vec3f(0.04239893, 0.07843017, 0.07917091);
const AGX_PIVOT = 10.0 / 16.5;
// s such that s·u/(1 + u^p)^(1/p) is 1/2 where u = 2·distance/s, at each end.
const AGX_TOE_SCALE = 0.5122774;
const AGX_SHOULDER_SCALE = 0.5414642;

fn agx_sigmoid(x: f32) -> f32 {
    let low = x < AGX_PIVOT;
    let power = select(3.25, 3.0, low);
    let scale = select(AGX_SHOULDER_SCALE, AGX_TOE_SCALE, low);
    let u = 2.0 * (x - AGX_PIVOT) / scale;
    return 0.5 + scale * u / pow(1.0 + pow(abs(u), power), 1.0 / power);
}

fn agx(color: vec3f) -> vec3f {
    let inset = 0.8 * color + dot(AGX_INSET, color);
    let stops = log2(max(inset, vec3f(1e-10)) / 0.18);
    let x = clamp((stops + 10.0) / 16.5, vec3f(0.0), vec3f(1.0));
    let encoded = vec3f(agx_sigmoid(x.r), agx_sigmoid(x.g), agx_sigmoid(x.b));
    let outset = (encoded - dot(AGX_INSET, encoded)) / 0.8;
    return pow(max(outset, vec3f(0.0)), vec3f(2.2));
}

// As in the Khronos PBR Neutral tone mapper's specification.
fn khronos_neutral(color: vec3f) -> vec3f {
    let start = 0.76;
    let least = min(color.r, min(color.g, color.b));
    let offset = select(0.04, least - 6.25 * least * least, least < 0.08);
    let base = color - offset;
    let peak = max(base.r, max(base.g, base.b));
    if (peak < start) { return base; }
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let toward_white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(base * (new_peak / peak), vec3f(new_peak), toward_white);
}

fn tone_mapped(color: vec3f) -> vec3f {
    var mapped = color;
    switch tone_curve() {
        case CURVE_REINHARD: { mapped = reinhard(color); }
        case CURVE_ACES: { mapped = aces(color); }
        case CURVE_AGX: { mapped = agx(color); }
        case CURVE_KHRONOS_NEUTRAL: { mapped = khronos_neutral(color); }
        default: {}
    }
    return clamp(mapped, vec3f(0.0), vec3f(1.0));
}
