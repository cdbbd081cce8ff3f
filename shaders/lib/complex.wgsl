// Complex numbers as vec2f (real, imaginary), and whole powers by squaring.

fn complex_product(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn complex_square(a: vec2f) -> vec2f {
    return vec2f((a.x - a.y) * (a.x + a.y), 2.0 * a.x * a.y);
}

// One step of left-to-right binary powering: a², times w where the exponent's next bit is set.
fn complex_power_bit(a: vec2f, w: vec2f, bit: u32) -> vec2f {
    let squared = complex_square(a);
    if (bit != 0u) { return complex_product(squared, w); }
    return squared;
}

// w^n for n from 1 to 31. With a constant n only its own products remain.
fn complex_power(w: vec2f, n: u32) -> vec2f {
    var a = w;
    if (n >= 16u) { a = complex_power_bit(a, w, n & 8u); }
    if (n >= 8u) { a = complex_power_bit(a, w, n & 4u); }
    if (n >= 4u) { a = complex_power_bit(a, w, n & 2u); }
    if (n >= 2u) { a = complex_power_bit(a, w, n & 1u); }
    return a;
}

fn real_power_bit(a: f32, x: f32, bit: u32) -> f32 {
    return select(a * a, a * a * x, bit != 0u);
}

// x^n for n from 1 to 31.
fn real_power(x: f32, n: u32) -> f32 {
    var a = x;
    if (n >= 16u) { a = real_power_bit(a, x, n & 8u); }
    if (n >= 8u) { a = real_power_bit(a, x, n & 4u); }
    if (n >= 4u) { a = real_power_bit(a, x, n & 2u); }
    if (n >= 2u) { a = real_power_bit(a, x, n & 1u); }
    return a;
}
