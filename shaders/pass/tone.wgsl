// Film to display: mean of the samples, exposure, tone curve, sRGB, dither.

const CURVE_REINHARD_LUMINANCE = 1u;

@group(2) @binding(2) var display: texture_storage_2d<rgba8unorm, write>;

// Reinhard et al. 2002, eq. 4, on luminance: colours keep their hue.
fn reinhard_luminance(color: vec3f) -> vec3f {
    let l = dot(color, vec3f(0.2126, 0.7152, 0.0722));
    return color * ((1.0 + l * picture.tone.inverse_white_squared) / (1.0 + l));
}

// IEC 61966-2-1.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(1e-10)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

// Interleaved gradient noise (Jimenez 2014), -1/2 to 1/2: one dither step keeps dark
// gradients free of bands. A function of the whole picture's pixel, so that tiles join.
fn dither(pixel: vec2u) -> f32 {
    let p = vec2f(pixel);
    return fract(52.9829189 * fract(dot(p, vec2f(0.06711056, 0.00583715)))) - 0.5;
}

// A film pixel, or the nearest one inside the region.
fn film_near(position: vec2i) -> vec3f {
    let inside = clamp(position, vec2i(0), vec2i(picture.size_px) - 1);
    return film_mean(pixel_index(vec2u(inside)));
}

// What the film says of a pixel. On a sparse lattice a lone sample can be brighter or darker
// than all that was filled in around it along the edges; it would stand out as a dot, and is
// held to its neighbours' range.
fn reconstructed(pixel: vec2u) -> vec3f {
    let own = film_mean(pixel_index(pixel));
    if (slice.spacing == 0u) { return own; }
    let at = vec2i(pixel);
    let left = film_near(at - vec2i(1, 0));
    let right = film_near(at + vec2i(1, 0));
    let above = film_near(at - vec2i(0, 1));
    let below = film_near(at + vec2i(0, 1));
    return clamp(own, min(min(left, right), min(above, below)), max(max(left, right), max(above, below)));
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    var color = reconstructed(pixel) * picture.tone.exposure;
    if (picture.tone.curve == CURVE_REINHARD_LUMINANCE) { color = reinhard_luminance(color); }
    let encoded = srgb_from_linear(clamp(color, vec3f(0.0), vec3f(1.0)));
    let dithered = encoded + dither(picture.origin_px + pixel) / 255.0;
    textureStore(display, pixel, vec4f(dithered, 1.0));
}
