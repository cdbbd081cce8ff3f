//! Combined zoom and pan: hyperbolic space.
//!
//! A place is a point and the view unit of a camera that looks at the point. Places form the half
//! space model of hyperbolic space: a pan by one view unit is as long as a zoom by the factor e,
//! at every zoom level, which matches how both look. The geodesic between two places is the smooth
//! zoom and pan of van Wijk and Nuij (2003, "Smooth and efficient zooming and panning", with
//! ρ = 1): zoom out, pan, zoom in.

use glam::{DVec3, DVec4};

use super::curve::Space;
use crate::precise::PrecisePoint;

/// Resolution of points, in view units: far below a pixel of any picture.
const GRAIN: f64 = 1e-12;

/// Minimum pan, as a fraction of a view unit or of the zoom's length.
///
/// Shorter pans count as zero.
const MIN_PAN: f64 = 1e-9;

/// A point and the view unit of a camera that looks at the point.
#[derive(Clone, Debug)]
pub struct Place {
    /// The point, in scene units.
    pub point: PrecisePoint,
    /// The view unit, in scene units; above 0.
    pub unit: f64,
}

impl Place {
    /// The place `pan` scene units away, with the view unit `unit`.
    fn moved(&self, pan: DVec3, unit: f64) -> Self {
        Self { point: self.point.moved_by(pan, GRAIN * unit), unit }
    }
}

/// The hyperbolic space of all places.
pub struct Places;

/// The geodesic between two places with different points: a half circle.
///
/// `s` is the arc length from the start. [`Self::begin`] and [`Self::end`] are arc lengths from
/// the half circle's top. The place at `s` is (van Wijk and Nuij's u and w, without cancellation)
///
/// `pan = u₀ sinh s / cosh(s + begin)`, `unit = u₀ cosh begin / cosh(s + begin)`.
struct Arc {
    /// Unit vector of the pan from the start to the end.
    pan_direction: DVec3,
    /// Arc length from the top to the start; negative if the start is before the top.
    begin: f64,
    /// Arc length from the top to the end; negative if the end is before the top.
    end: f64,
}

impl Arc {
    /// The geodesic from `a` to `b`; none if both have the same point, up to [`MIN_PAN`].
    fn of(a: &Place, b: &Place) -> Option<Self> {
        let pan = &b.point - &a.point;
        let distance = pan.length();
        if distance <= MIN_PAN * a.unit.min(b.unit) {
            return None;
        }
        let from_top = |unit: f64, sign: f64| {
            let squares = (b.unit - a.unit) * ((b.unit + a.unit) / distance) + sign * distance;
            -(squares / (2.0 * unit)).asinh()
        };
        let (begin, end) = (from_top(a.unit, 1.0), from_top(b.unit, -1.0));
        Some(Self { pan_direction: pan / distance, begin, end })
    }

    fn length(&self) -> f64 {
        self.end - self.begin
    }
}

/// The place on a half circle at the arc length `length` from `start`.
///
/// `begin` is the arc length from the half circle's top to `start`.
fn along(start: &Place, pan_direction: DVec3, begin: f64, length: f64) -> Place {
    let scale = start.unit / (length + begin).cosh();
    start.moved(pan_direction * (length.sinh() * scale), begin.cosh() * scale)
}

impl Space for Places {
    type Point = Place;

    fn between(&self, a: &Place, b: &Place, part: f64) -> Place {
        let Some(arc) = Arc::of(a, b) else {
            let unit = a.unit * (b.unit / a.unit).powf(part);
            return a.moved((&b.point - &a.point) * part, unit);
        };
        // Computed from the nearer end, because an f64 offset from the other end may be too
        // coarse for this end's view unit.
        if part <= 0.5 {
            along(a, arc.pan_direction, arc.begin, part * arc.length())
        } else {
            along(b, -arc.pan_direction, -arc.end, (1.0 - part) * arc.length())
        }
    }

    fn velocity(&self, a: &Place, b: &Place) -> DVec4 {
        match Arc::of(a, b) {
            None => DVec4::new(0.0, 0.0, 0.0, (b.unit / a.unit).ln()),
            Some(arc) => {
                (arc.pan_direction / arc.begin.cosh()).extend(-arc.begin.tanh()) * arc.length()
            }
        }
    }

    fn after(&self, a: &Place, velocity: DVec4) -> Place {
        let pan = velocity.truncate();
        // During a long zoom out, the direction's rounding errors would grow with the view unit.
        if pan.length() <= MIN_PAN * velocity.w.abs() {
            return Place { point: a.point.clone(), unit: a.unit * velocity.w.exp() };
        }
        let begin = (-velocity.w / pan.length()).asinh();
        along(a, pan.normalize(), begin, velocity.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, unit: f64) -> Place {
        Place { point: DVec3::new(x, 0.25, -0.5).into(), unit }
    }

    /// Hyperbolic distance by the usual formula, which is accurate in f64 for near places only.
    fn distance(a: &Place, b: &Place) -> f64 {
        let pan = (&b.point - &a.point).length();
        let squares = pan.powi(2) + (b.unit - a.unit).powi(2);
        2.0 * (squares.sqrt() / (2.0 * (a.unit * b.unit).sqrt())).asinh()
    }

    #[test]
    fn geodesics_are_shortest_and_have_constant_speed() {
        for (a, b) in [
            (place(0.0, 1.0), place(0.7, 0.02)),
            (place(0.0, 0.1), place(3.0, 0.1)),
            (place(0.0, 0.5), place(0.0, 2.0)),
            (place(1.0, 1e-6), place(-1.0, 1e-3)),
        ] {
            let length = distance(&a, &b);
            assert!((Places.velocity(&a, &b).length() - length).abs() < 1e-9 * length);
            for part in [0.1, 0.3, 0.5, 0.8] {
                let middle = Places.between(&a, &b, part);
                assert!((distance(&a, &middle) - part * length).abs() < 1e-6 * length, "{part}");
                assert!((distance(&middle, &b) - (1.0 - part) * length).abs() < 1e-6 * length);
            }
        }
    }

    #[test]
    fn after_inverts_velocity() {
        for (a, b) in [
            (place(0.0, 1.0), place(0.7, 0.02)),
            (place(0.0, 0.1), place(3.0, 0.1)),
            (place(0.5, 2.0), place(0.5, 0.5)),
        ] {
            let reached = Places.after(&a, Places.velocity(&a, &b));
            assert!(distance(&reached, &b) < 1e-7, "{reached:?} for {b:?}");
        }
    }

    #[test]
    fn a_deep_end_is_exact() {
        let deep = Place {
            point: PrecisePoint([
                "0.70000000000000000000000000000000123456789".parse().unwrap(),
                "0.25".parse().unwrap(),
                "-0.5".parse().unwrap(),
            ]),
            unit: 3e-28,
        };
        let near = Places.between(&place(0.0, 1.0), &deep, 1.0 - 1e-9);
        assert!((&near.point - &deep.point).length() < 1e-6 * deep.unit);
        assert!((near.unit / deep.unit - 1.0).abs() < 1e-6);
    }
}
