// Complex numbers as vec2f (real, imaginary), numbers p + i q √a as vec2f(p, q), and their whole
// powers by squaring. A constant exponent leaves only its own products in the compiled code.

fn complex_product(v: vec2f, w: vec2f) -> vec2f {
    return vec2f(v.x * w.x - v.y * w.y, v.x * w.y + v.y * w.x);
}

fn complex_square(v: vec2f) -> vec2f {
    return vec2f((v.x - v.y) * (v.x + v.y), (v.x + v.x) * v.y);
}

// One step of left-to-right binary powering: v², times w if the exponent's next bit is set.
fn complex_power_bit(v: vec2f, w: vec2f, bit: u32) -> vec2f {
    let squared = complex_square(v);
    if (bit != 0u) { return complex_product(squared, w); }
    return squared;
}

// w^n for n from 1 to 15.
fn complex_power(w: vec2f, n: u32) -> vec2f {
    var v = w;
    if (n >= 8u) { v = complex_power_bit(v, w, n & 4u); }
    if (n >= 4u) { v = complex_power_bit(v, w, n & 2u); }
    if (n >= 2u) { v = complex_power_bit(v, w, n & 1u); }
    return v;
}

fn rooted_product(a: f32, v: vec2f, w: vec2f) -> vec2f {
    return vec2f(v.x * w.x - a * (v.y * w.y), v.x * w.y + v.y * w.x);
}

fn rooted_power_bit(a: f32, v: vec2f, w: vec2f, bit: u32) -> vec2f {
    let squared = vec2f(v.x * v.x - a * (v.y * v.y), (v.x + v.x) * v.y);
    if (bit != 0u) { return rooted_product(a, squared, w); }
    return squared;
}

// w^n for n from 1 to 15.
fn rooted_power(a: f32, w: vec2f, n: u32) -> vec2f {
    var v = w;
    if (n >= 8u) { v = rooted_power_bit(a, v, w, n & 4u); }
    if (n >= 4u) { v = rooted_power_bit(a, v, w, n & 2u); }
    if (n >= 2u) { v = rooted_power_bit(a, v, w, n & 1u); }
    return v;
}

fn real_power_bit(v: f32, x: f32, bit: u32) -> f32 {
    return select(v * v, v * v * x, bit != 0u);
}

// x^n for n from 0 to 15.
fn real_power(x: f32, n: u32) -> f32 {
    if (n == 0u) { return 1.0; }
    var v = x;
    if (n >= 8u) { v = real_power_bit(v, x, n & 4u); }
    if (n >= 4u) { v = real_power_bit(v, x, n & 2u); }
    if (n >= 2u) { v = real_power_bit(v, x, n & 1u); }
    return v;
}
