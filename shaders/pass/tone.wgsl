// Film to display: mean of the samples, exposure, tone curve, bloom, sRGB, dither or 16 bits.
// uses: lib/curve, lib/exposure, lib/eye, lib/film_mean, lib/lattice, lib/mip, lib/srgb
// uses: types/dispatch_params, types/frame_uniforms, types/post

// What this pipeline is specialised for: 0 no, 1 yes, -1 reads it from the uniforms.
override BLOOM: i32 = -1;
override ANAGLYPH: i32 = -1;
override SPARSE: i32 = -1;

fn has_bloom() -> bool {
    if (BLOOM >= 0) { return BLOOM == 1; }
    return frame.bloom.strength > 0.0;
}

fn is_anaglyph() -> bool {
    if (ANAGLYPH >= 0) { return ANAGLYPH == 1; }
    return frame.eyes.anaglyph != 0u;
}

fn is_sparse() -> bool {
    if (SPARSE >= 0) { return SPARSE == 1; }
    return dispatch.spacing != 0u;
}

// Denoised light, packed by `shared_exponent_pack`.
@group(3) @binding(0) var<storage, read> denoised: array<u32>;

@group(2) @binding(2) var display: texture_storage_2d<rgba8unorm, write>;

// The film at `offset` from a pixel; the pixel's own value outside the region or in another eye's part.
fn film_beside(pixel: vec2u, offset: vec2i) -> vec3f {
    let inside = vec2u(clamp(vec2i(pixel) + offset, vec2i(0), vec2i(frame.size_px) - 1));
    let same_eye = is_second_eye(inside) == is_second_eye(pixel);
    return film_mean(pixel_index(select(pixel, inside, same_eye)));
}

// The film's value of a pixel. On a sparse lattice a lone sample can be brighter or darker than all
// pixels that were filled in around it along edges. The clamp to its neighbours' range keeps
// the sample from standing out as a dot.
fn reconstructed(pixel: vec2u) -> vec3f {
    if (dispatch.denoised != 0u) { return shared_exponent_unpack(denoised[pixel_index(pixel)]); }
    let own = film_mean(pixel_index(pixel));
    var low = vec3f(3e38);
    var high = vec3f(-3e38);
    // A loop, here and over the eyes: a software GPU computes both sides of a branch, but skips a loop without turns.
    let sides = select(0u, 4u, is_sparse());
    for (var side = 0u; side < sides; side++) {
        let toward = 1 - 2 * i32(side & 1u);
        let beside = film_beside(pixel, select(vec2i(toward, 0), vec2i(0, toward), side > 1u));
        low = min(low, beside);
        high = max(high, beside);
    }
    return select(own, clamp(own, low, high), is_sparse());
}

fn mip_element(width: u32, cell: vec2u) -> vec3f {
    return mips[statistics.bloom_start + cell.y * width + cell.x].rgb;
}

// The bloom at a pixel. The blurred mip level covers the whole picture, so the lookup uses the pixel's
// position in its own eye's part, for any region.
fn bloom_at(pixel: vec2u) -> vec3f {
    let levels = Levels(statistics.eye_px, sheet_eyes());
    let level = statistics.bloom_level;
    let size = mip_eye_size(levels, level);
    let width = size.x * levels.eyes.x;
    let corner = eye_on_sheet(pixel) * size;
    let place = eye_position(pixel, vec2f(0.5));
    let at = place * vec2f(levels.eye_px) / f32(1u << level) - 0.5;
    let inside = clamp(at, vec2f(0.0), vec2f(size - 1u));
    let low = corner + vec2u(inside);
    let high = min(low + 1u, corner + size - 1u);
    let part = fract(inside);
    let above = mix(mip_element(width, low), mip_element(width, vec2u(high.x, low.y)), part.x);
    let below = mix(mip_element(width, vec2u(low.x, high.y)), mip_element(width, high), part.x);
    return mix(above, below, part.y);
}

fn shown(pixel: vec2u) -> vec3f {
    var color = reconstructed(pixel) * exposure_factor();
    var bloom = vec3f(0.0);
    if (has_bloom()) { bloom = frame.bloom.strength * bloom_at(pixel); }
    if (frame.bloom.after == 0u) { color += bloom; }
    color = tone_mapped(color);
    if (frame.bloom.after != 0u) { color = min(color + bloom, vec3f(1.0)); }
    return srgb_from_linear(color);
}

// Alpha: the part of a pixel's samples that is not transparent.
fn alpha(pixel: vec2u) -> f32 {
    let samples = frame.background.transparent_samples;
    if (samples == 0.0) { return 1.0; }
    return saturate(film_bw[pixel_index(pixel)].y / samples);
}

// Stores display values of 0 to 1: of 8 bits, dithered, or of 16 bits, as high and low bytes in two texels.
fn show(pixel: vec2u, encoded: vec3f) {
    let part = alpha(pixel);
    // The film has no colour where all is transparent.
    let color = select(encoded, vec3f(0.0), part == 0.0);
    if (frame.tone.is_deep == 0u) {
        let dithered = color + dither(frame.origin_px + eye_pixel(pixel)) / 255.0;
        textureStore(display, pixel, vec4f(dithered, part));
        return;
    }
    let steps = vec4u(round(vec4f(saturate(color), part) * 65535.0));
    let first = vec2u(2u * pixel.x, pixel.y);
    // A quarter more than the byte, for devices that round down.
    textureStore(display, first, (vec4f(steps >> vec4u(8u)) + 0.25) / 255.0);
    textureStore(display, first + vec2u(1u, 0u), (vec4f(steps & vec4u(255u)) + 0.25) / 255.0);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    if (is_anaglyph() && is_second_eye(pixel)) { return; }
    var encoded = vec3f(0.0);
    let eyes = select(1u, 2u, is_anaglyph());
    for (var eye = 0u; eye < eyes; eye++) {
        let color = shown(pixel + eye * frame.eyes.second_at);
        // The left glass is red and passes the left eye's red; the right glass passes green and blue.
        encoded = select(color, vec3f(encoded.r, color.gb), eye == 1u);
    }
    show(pixel, encoded);
}
