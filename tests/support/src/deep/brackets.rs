//! Where the surface along a ray may be said to be: not before it is near, and not behind what no ray passes.
//!
//! Brackets are of short steps and wider than the hit distance's own rounding, so a depth outside of its
//! bracket is wrong.

use glam::DVec3;
use mandelight::formula::mandelbulb::Mandelbulb;

use super::rays::{SetView, Way};

/// Part of the hit distance within which a ray ends for certain.
const CERTAIN: f64 = 0.5;
/// Hit distances within which a ray may end.
const POSSIBLE: f64 = 2.0;
/// Part of the safe step that a step of the bracket's march covers.
const FINE: f64 = 0.25;
/// At powers below 4, the hit distances for which a ray must be near for its end to be certain.
const THICK: f64 = 1.0;
/// Points at which that is asked.
const ASKED: u32 = 8;

/// What a picture's depth along a ray is, held to the bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Within the bracket.
    Right,
    /// The ray ends in the open.
    TooNear,
    /// The ray has passed a surface, or missed it.
    TooFar,
}

impl SetView<'_> {
    /// Judges the depth that a picture has along a direction; none is a miss.
    pub fn judge(&self, direction: DVec3, found: Option<f64>) -> Verdict {
        if let Some(depth) = found
            && self.nearness(direction, depth) > POSSIBLE
        {
            return Verdict::TooNear;
        }
        let end = found.map_or(f64::INFINITY, |depth| depth - 2.0 * self.footprint(depth));
        match self.certain_depth(direction, end) {
            Some(_) => Verdict::TooFar,
            None => Verdict::Right,
        }
    }

    /// The distance estimate over the hit distance, at a depth.
    pub fn nearness(&self, direction: DVec3, depth: f64) -> f64 {
        self.estimate(direction, depth).distance / self.hit_distance(depth)
    }

    /// The first depth below `end` at which no ray is still on its way.
    fn certain_depth(&self, direction: DVec3, end: f64) -> Option<f64> {
        let is_low = Mandelbulb::of(self.fractal()).power < 4.0;
        let is_certain = |depth: f64| {
            let thick = THICK * self.hit_distance(depth);
            let mut asked = (1..=ASKED).map(|i| depth + thick * f64::from(i) / f64::from(ASKED));
            !is_low || asked.all(|depth| self.nearness(direction, depth) < CERTAIN)
        };
        let way = self.look_along(
            direction,
            |estimate| FINE * estimate.step,
            |depth, estimate| {
                if depth >= end {
                    return Some(None);
                }
                let is_near = estimate.distance < CERTAIN * self.hit_distance(depth);
                (is_near && is_certain(depth)).then_some(Some(depth))
            },
        );
        match way {
            Way::Answered(depth) => depth,
            Way::Past | Way::Creeping(_) => None,
        }
    }
}
