// Linear light to sRGB display values, and the dither that hides their steps.
// uses: lib/noise

// IEC 61966-2-1.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(1e-10)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

// Noise from -1/2 to 1/2: one dither step avoids bands in dark gradients. A function of the pixel's
// position in the whole picture, so that tiles join.
fn dither(pixel: vec2u) -> f32 {
    return fract(interleaved(vec2f(pixel))) - 0.5;
}
