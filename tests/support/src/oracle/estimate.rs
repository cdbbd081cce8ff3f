//! Oracle: Algorithm 1, as it is printed but for orbits that do not pass the bailout, in f64, with asin, atan2, sin and cos.
//!
//! The line for z.y, missing in print, is restored by symmetry with z.x. Equation 2.3's −sin φ
//! is the negative variant. The Julia form starts at the point, adds the constant, and drops the
//! derivative of that constant, which is the + 1 of line 10.

use glam::DVec3;
use mandelight::formula::mandelbulb::{Mandelbulb, Sine};

/// How an orbit ended.
pub struct Orbit {
    /// Steps done.
    pub steps: u32,
    /// |z| at the end.
    pub r: f64,
    /// The scalar derivative at the end.
    pub dr: f64,
    /// Least distances from the origin, the z axis and the plane z = 0 of all points but the
    /// first; at most 2.
    pub traps: [f64; 3],
    /// All points but the first.
    pub points: Vec<DVec3>,
}

/// Follows the orbit of `point`.
pub fn orbit(fractal: &Mandelbulb, point: DVec3) -> Orbit {
    let n = fractal.power;
    let sine = if fractal.sine == Sine::Negative { -1.0 } else { 1.0 };
    let (c, one) =
        if fractal.julia { (DVec3::from_array(fractal.julia_constant), 0.0) } else { (point, 1.0) };
    let mut z = point;
    let mut r = z.length();
    let mut dr = 1.0;
    let mut steps = 0;
    let mut traps = [2.0_f64; 3];
    let mut points = Vec::new();
    while r <= fractal.bailout && steps < fractal.iterations {
        steps += 1;
        let ph = if r > 0.0 { (z.z / r).clamp(-1.0, 1.0).asin() } else { 0.0 };
        let th = z.y.atan2(z.x);
        let mut zr = r.powf(n - 1.0);
        dr = zr * dr * n + one;
        zr *= r;
        let (sph, cph) = ((n * ph).sin(), (n * ph).cos());
        let (sth, cth) = ((n * th).sin(), (n * th).cos());
        z = DVec3::new(zr * cph * cth + c.x, zr * cph * sth + c.y, sine * zr * sph + c.z);
        r = z.length();
        traps = [
            traps[0].min(r),
            traps[1].min((z.x * z.x + z.y * z.y).sqrt()),
            traps[2].min(z.z.abs()),
        ];
        points.push(z);
    }
    Orbit { steps, r, dr, traps, points }
}

/// Distance estimate as it is printed: ½ ln r · r / dr, and 0 where ln r < 0 or r = 0.
pub fn printed_distance(fractal: &Mandelbulb, point: DVec3) -> f64 {
    let Orbit { r, dr, .. } = orbit(fractal, point);
    if r == 0.0 || r.ln() < 0.0 { 0.0 } else { 0.5 * r.ln() * r / dr }
}

/// Distance estimate: as printed for an orbit that passes the bailout. For another, r is counted in escape radii, and the
/// estimate is 0 within one.
pub fn distance(fractal: &Mandelbulb, point: DVec3) -> f64 {
    let Orbit { r, dr, .. } = orbit(fractal, point);
    let log = if r > fractal.bailout { r.ln() } else { (r / escape_radius(fractal)).ln() };
    if log <= 0.0 { 0.0 } else { 0.5 * log * r / dr }
}

/// The radius R from which |z|ⁿ − |c| is greater than |z|, so that orbits grow; |c| is at most R for the Mandelbulb.
pub fn escape_radius(fractal: &Mandelbulb) -> f64 {
    let added = DVec3::from_array(fractal.julia_constant).length();
    let grows = |r: f64| r.powf(fractal.power) - if fractal.julia { added } else { r } > r;
    let (mut below, mut above) = (1.0, 8.0);
    for _ in 0..60 {
        let middle = 0.5 * (below + above);
        *(if grows(middle) { &mut above } else { &mut below }) = middle;
    }
    above
}

/// Smooth iteration count: N − ln(ln r / ln b) / ln n for an orbit that passes the bailout b after
/// N steps, N for one that does not. Equation 3.1 is this with n = 2 and b = 2.
pub fn smooth_iterations(fractal: &Mandelbulb, point: DVec3) -> f64 {
    let Orbit { steps, r, .. } = orbit(fractal, point);
    let n = f64::from(steps);
    if r > fractal.bailout {
        n - (r.ln() / fractal.bailout.ln()).ln() / fractal.power.ln()
    } else {
        n
    }
}

/// What one step does to a small displacement of z at most: the norm of the power's derivative,
/// `n r^(n−1) max(1, |cos nφ / cos φ|)`, longitudes being stretched by the last factor. Its product
/// along an orbit bounds what rounding does to a distance estimate.
pub fn error_growth(fractal: &Mandelbulb, point: DVec3) -> f64 {
    let n = fractal.power;
    let c = if fractal.julia { DVec3::from_array(fractal.julia_constant) } else { point };
    let sine = if fractal.sine == Sine::Negative { -1.0 } else { 1.0 };
    let (mut z, mut growth, mut steps) = (point, 1.0, 0);
    while z.length() <= fractal.bailout && steps < fractal.iterations {
        steps += 1;
        let r = z.length();
        let (ph, th) = (z.z.atan2(z.x.hypot(z.y)), z.y.atan2(z.x));
        let stretch = ((n * ph).cos() / ph.cos()).abs().max(1.0);
        growth = (growth * n * r.powf(n - 1.0) * stretch).max(1.0);
        let cph = (n * ph).cos();
        z = r.powf(n)
            * DVec3::new(cph * (n * th).cos(), cph * (n * th).sin(), sine * (n * ph).sin())
            + c;
    }
    growth
}
