//! Positions that go with the zoom.
//!
//! A place is a point and the view unit at which it is looked at. Places form the half space
//! model of hyperbolic space: a step of one view unit aside and a zoom by the factor e are
//! equally long, at every zoom level, which is how they look. The shortest line between two
//! places is the smooth zoom and pan of van Wijk and Nuij (2003, "Smooth and efficient zooming
//! and panning", with ρ = 1): out as far as the way aside asks for, across, and in again.

use glam::{DVec3, DVec4};

use super::curve::Space;
use crate::scene::PrecisePoint;

/// How fine points are kept, in view units: far below a pixel of any picture.
const GRAIN: f64 = 1e-12;

/// Ways aside shorter than this part of a view unit, or of the way in depth, are not told from none.
const ASIDE: f64 = 1e-9;

/// A point and the view unit at which it is looked at.
#[derive(Clone, Debug)]
pub struct Place {
    /// The point, in scene units.
    pub point: PrecisePoint,
    /// The view unit, in scene units; above 0.
    pub unit: f64,
}

impl Place {
    /// This place `aside` scene units away, at another view unit.
    fn moved(&self, aside: DVec3, unit: f64) -> Self {
        Self { point: self.point.moved_by(aside, GRAIN * unit), unit }
    }
}

/// Hyperbolic space.
pub struct Places;

/// The shortest line between two places that do not lie above one another: a half circle. With
/// `s` the length from its beginning and [`Self::begin`] and [`Self::end`] counted from its top,
/// the place at `s` is (van Wijk and Nuij's u and w, free of cancellation)
///
/// `aside = u₀ sinh s / cosh(s + begin)`, `unit = u₀ cosh begin / cosh(s + begin)`.
struct Arc {
    /// Unit vector from the beginning aside to the end.
    aside: DVec3,
    /// Length from the half circle's top to the beginning; negative before it.
    begin: f64,
    /// The same to the end.
    end: f64,
}

impl Arc {
    /// The line from `a` to `b`; none where one lies above the other.
    fn of(a: &Place, b: &Place) -> Option<Self> {
        let way = &b.point - &a.point;
        let distance = way.length();
        if distance <= ASIDE * a.unit.min(b.unit) {
            return None;
        }
        let from_top = |unit: f64, sign: f64| {
            let squares = (b.unit - a.unit) * ((b.unit + a.unit) / distance) + sign * distance;
            -(squares / (2.0 * unit)).asinh()
        };
        let (begin, end) = (from_top(a.unit, 1.0), from_top(b.unit, -1.0));
        Some(Self { aside: way / distance, begin, end })
    }

    fn length(&self) -> f64 {
        self.end - self.begin
    }
}

/// The place on a half circle, `length` from `start`, which lies `begin` from the top.
fn along(start: &Place, aside: DVec3, begin: f64, length: f64) -> Place {
    let scale = start.unit / (length + begin).cosh();
    start.moved(aside * (length.sinh() * scale), begin.cosh() * scale)
}

impl Space for Places {
    type Point = Place;

    fn between(&self, a: &Place, b: &Place, part: f64) -> Place {
        let Some(arc) = Arc::of(a, b) else {
            let unit = a.unit * (b.unit / a.unit).powf(part);
            return a.moved((&b.point - &a.point) * part, unit);
        };
        // From the nearer end: seen from there the numbers are exact to the last digit, and the
        // other end may lie more digits away than an f64 has.
        if part <= 0.5 {
            along(a, arc.aside, arc.begin, part * arc.length())
        } else {
            along(b, -arc.aside, -arc.end, (1.0 - part) * arc.length())
        }
    }

    fn velocity(&self, a: &Place, b: &Place) -> DVec4 {
        match Arc::of(a, b) {
            None => DVec4::new(0.0, 0.0, 0.0, (b.unit / a.unit).ln()),
            Some(arc) => (arc.aside / arc.begin.cosh()).extend(-arc.begin.tanh()) * arc.length(),
        }
    }

    fn after(&self, a: &Place, velocity: DVec4) -> Place {
        let aside = velocity.truncate();
        // On a long way out, rounding errors of the direction would grow with the zoom.
        if aside.length() <= ASIDE * velocity.w.abs() {
            return Place { point: a.point.clone(), unit: a.unit * velocity.w.exp() };
        }
        let begin = (-velocity.w / aside.length()).asinh();
        along(a, aside.normalize(), begin, velocity.length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(x: f64, unit: f64) -> Place {
        Place { point: DVec3::new(x, 0.25, -0.5).into(), unit }
    }

    /// Hyperbolic distance by its usual formula, which only holds for near places in f64.
    fn distance(a: &Place, b: &Place) -> f64 {
        let aside = (&b.point - &a.point).length();
        let squares = aside.powi(2) + (b.unit - a.unit).powi(2);
        2.0 * (squares.sqrt() / (2.0 * (a.unit * b.unit).sqrt())).asinh()
    }

    #[test]
    fn lines_are_shortest_and_gone_through_at_one_speed() {
        for (a, b) in [
            (place(0.0, 1.0), place(0.7, 0.02)),
            (place(0.0, 0.1), place(3.0, 0.1)),
            (place(0.0, 0.5), place(0.0, 2.0)),
            (place(1.0, 1e-6), place(-1.0, 1e-3)),
        ] {
            let whole = distance(&a, &b);
            assert!((Places.velocity(&a, &b).length() - whole).abs() < 1e-9 * whole);
            for part in [0.1, 0.3, 0.5, 0.8] {
                let middle = Places.between(&a, &b, part);
                assert!((distance(&a, &middle) - part * whole).abs() < 1e-6 * whole, "{part}");
                assert!((distance(&middle, &b) - (1.0 - part) * whole).abs() < 1e-6 * whole);
            }
        }
    }

    #[test]
    fn leaving_with_the_velocity_toward_a_place_arrives_there() {
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
    fn both_ends_are_exact_however_deep() {
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
