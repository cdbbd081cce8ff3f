// Interleaved gradient noise (Jimenez 2014) at a position in pixels; the noise is the result's fraction.
fn interleaved(place: vec2f) -> f32 {
    return 52.9829189 * fract(dot(place, vec2f(0.06711056, 0.00583715)));
}
