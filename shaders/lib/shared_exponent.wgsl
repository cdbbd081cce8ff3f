// Colours in 32 bits: nine bits per channel and a shared exponent of five bits (the format
// rgb9e5ufloat). The largest channel keeps a relative precision of 1/512.

fn shared_exponent_pack(color: vec3f) -> u32 {
    let inside = clamp(color, vec3f(0.0), vec3f(65408.0));
    let largest = max(max(inside.r, inside.g), inside.b);
    // The bits of an f32 hold its exponent.
    var exponent = max(i32(bitcast<u32>(largest) >> 23u) - 127, -16) + 16;
    // Rounding up may need the next exponent.
    if (round(largest * exp2(f32(24 - exponent))) >= 512.0) { exponent += 1; }
    let mantissas = vec3u(round(inside * exp2(f32(24 - exponent))));
    return mantissas.r | (mantissas.g << 9u) | (mantissas.b << 18u) | (u32(exponent) << 27u);
}

fn shared_exponent_unpack(packed: u32) -> vec3f {
    let mantissas = vec3u(packed, packed >> 9u, packed >> 18u) & vec3u(511u);
    return vec3f(mantissas) * exp2(f32(packed >> 27u) - 24.0);
}
