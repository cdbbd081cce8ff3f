// Linear light to display values, and what hides their steps.

// IEC 61966-2-1.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3f(1e-10)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3f(0.0031308));
}

// Noise from -1/2 to 1/2: one dither step keeps dark gradients free of bands. A function of the
// whole picture's pixel, so that tiles join.
fn dither(pixel: vec2u) -> f32 {
    return fract(interleaved(vec2f(pixel))) - 0.5;
}
