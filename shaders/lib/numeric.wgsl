// Elementary functions at full f32 accuracy. WGSL guarantees its own only to 2^-11 (sin, cos),
// 4096 ulp (atan2) and 2^-21 absolute (log2), too coarse for orbits of a real power.
// The polynomials have the least maximum error of their degree and are summed in pairs (Estrin):
// several short chains of operations instead of one long chain.

// log2(x) for normal x > 0, about 1 ulp: exponent plus an atanh series on [sqrt(1/2), sqrt(2)).
fn accurate_log2(x: f32) -> f32 {
    let bits = bitcast<u32>(x);
    // Moves the split from 1 to sqrt(1/2) = 0x3f3504f3.
    let exponent = (i32(bits) - 0x3f3504f3) >> 23u;
    let mantissa = bitcast<f32>(bits - (u32(exponent) << 23u));
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let q = s * s;
    let series = (2.88539009 + q * 0.961796341) + q * q * (0.576913935 + q * 0.427533686);
    return f32(exponent) + s * series;
}

// 2^x for x up to 127, about 2 ulp; 2^-126 for all x below -126.
fn accurate_exp2(x: f32) -> f32 {
    let within = max(x, -126.0);
    let whole = round(within);
    let f = within - whole;
    let q = f * f;
    let low = (1.0 + f * 0.693147203) + q * (0.240226479 + f * 0.0555033246);
    let high = (0.00961843736 + f * 0.00133988789) + q * 0.000153533734;
    return (low + q * q * high) * bitcast<f32>(u32(i32(whole) + 127) << 23u);
}

// (cos, sin) of an angle in turns, absolute error about 1e-7. Reduction to the nearest quarter turn leaves
// at most an eighth of a turn on either side for the series.
fn cos_sin_turns(turns: f32) -> vec2f {
    let quarter = round(turns * 4.0);
    let t = turns * 4.0 - quarter;
    let q = t * t;
    let c = 1.0 + q * ((-1.23370054 + q * 0.253669244) + q * q * (-0.0208602885 + q * 0.000904021656));
    let s = t * ((1.57079631 - q * 0.64596294) + q * q * (0.0796759 - q * 0.00459229));
    let k = i32(quarter);
    let turned = select(vec2f(c, s), vec2f(-s, c), (k & 1) != 0);
    return select(turned, -turned, (k & 2) != 0);
}

// The angle of (x, y) in turns, -1/2 to 1/2; not for the origin. Absolute error about 2e-8.
fn angle_turns(y: f32, x: f32) -> f32 {
    let steep = abs(y) > abs(x);
    let t = select(abs(y), abs(x), steep) / select(abs(x), abs(y), steep);
    let q = t * t;
    let q2 = q * q;
    let low = (0.159154925 - q * 0.0530504758) + q2 * (0.0318085585 - q * 0.022538296);
    let high = (0.0167095908 - q * 0.0115146312) + q2 * (0.00633137599 - q * 0.00229204578);
    let acute = t * (low + q2 * q2 * (high + q2 * q2 * 0.000390999465));
    let near = select(acute, 0.25 - acute, steep);
    let right = select(near, 0.5 - near, x < 0.0);
    return select(right, -right, y < 0.0);
}
