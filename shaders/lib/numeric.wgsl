// Elementary functions at full f32 accuracy. WGSL promises its own only to 2^-11 (sin, cos),
// 4096 ulp (atan2) and 2^-21 absolute (log2), too coarse for orbits of a real power.

const TAU = 6.2831853071795864769;

// log2(x) for normal x > 0, about 1 ulp: exponent plus an atanh series on [sqrt(1/2), sqrt(2)).
fn accurate_log2(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    // Move the split from 1 to sqrt(1/2) = 0x3f3504f3.
    let exponent = (i32(bits) - 0x3f3504f3) >> 23u;
    let mantissa = bitcast<f32>(bits - (u32(exponent) << 23u));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let series = 1.0 + q * (0.33333333 + q * (0.2 + q * (0.14285715 + q * 0.11111111)));
    return f32(exponent) + s * series * 2.8853900817779268;
}

// 2^x for x in [-126, 127], about 2 ulp.
fn accurate_exp2(x: f32) -> f32 {
    let clamped = clamp(x, -126.0, 127.0);
    let whole = round(clamped);
    let f = (clamped - whole) * 0.69314718;
    let series = 1.0 + f * (1.0 + f * (0.5 + f * (0.16666667 + f * (0.041666668
        + f * (0.0083333338 + f * (0.0013888889 + f * 0.00019841270))))));
    return series * bitcast<f32>(u32(i32(whole) + 127) << 23u);
}

// (cos, sin) of an angle given in turns, absolute error about 1e-7.
fn cos_sin_turns(turns: f32) -> vec2f {
    // Quarter turns leave an eighth of a turn on either side for the series.
    let reduced = turns - round(turns);
    let quarter = round(reduced * 4.0);
    let a = (reduced - quarter * 0.25) * TAU;
    let q = a * a;
    let s = a * (1.0 + q * (-0.16666667 + q * (0.0083333333 + q * (-0.00019841270 + q * 2.7557319e-6))));
    let c = 1.0 + q * (-0.5 + q * (0.041666667 + q * (-0.0013888889 + q * (2.4801587e-5 - q * 2.7557319e-7))));
    let k = i32(quarter) & 3;
    if (k == 0) { return vec2f(c, s); }
    if (k == 1) { return vec2f(-s, c); }
    if (k == 2) { return vec2f(-c, -s); }
    return vec2f(s, -c);
}

// The angle of (x, y) in turns, in [-1/2, 1/2]; 0 at the origin. Absolute error about 3e-8.
fn angle_turns(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let large = max(ax, ay);
    if (large == 0.0) { return 0.0; }
    var t = min(ax, ay) / large;
    // atan(t) = pi/4 + atan((t - 1) / (t + 1)) keeps the series' argument below tan(pi/8).
    var base = 0.0;
    if (t > 0.41421356) {
        t = (t - 1.0) / (t + 1.0);
        base = 0.125;
    }
    let q = t * t;
    let series = t * (1.0 + q * (-0.33333333 + q * (0.2 + q * (-0.14285714 + q * (0.11111111
        + q * (-0.09090909 + q * (0.07692308 - q * 0.06666667)))))));
    var turns = base + series / TAU;
    if (ay > ax) { turns = 0.25 - turns; }
    if (x < 0.0) { turns = 0.5 - turns; }
    return select(turns, -turns, y < 0.0);
}
