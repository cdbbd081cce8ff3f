//! Bounding spheres of escape-time sets.

/// Safety margin for rounding, as a part of the bounding radius.
const MARGIN: f64 = 0.01;

/// Radius about the origin beyond which every orbit of z ← zᵖ + c escapes.
///
/// The result includes a margin of one percent. An orbit escapes if |z| passes `bailout` within `iterations`.
/// `power` is p, above 1; `constant` is |c|, or none where c is the orbit's starting point.
///
/// By the triangle inequality |zᵖ + c| ≥ |z|ᵖ − |c|, so the slowest possible orbit from radius R is x₀ = R,
/// x ← xᵖ − K with K = |c| or R. Bisection finds the least R whose slowest orbit escapes; an orbit that
/// starts past the bailout has escaped.
pub fn slowest_escape(power: f64, constant: Option<f64>, iterations: u32, bailout: f64) -> f64 {
    let escapes = |radius: f64| {
        let pull = constant.unwrap_or(radius);
        let mut x = radius;
        for _ in 0..iterations {
            if x > bailout {
                return true;
            }
            // A bound that shrinks once shrinks for ever: the orbit does not escape.
            let next = x.powf(power) - pull;
            if next <= x {
                return false;
            }
            x = next;
        }
        x > bailout
    };
    let (mut inside, mut outside) = (0.0, bailout);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if escapes(middle) {
            outside = middle;
        } else {
            inside = middle;
        }
    }
    outside * (1.0 + MARGIN)
}
