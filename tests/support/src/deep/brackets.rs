//! Where the surface along a ray may be said to be: not before it is near, and not behind what no ray passes.
//!
//! Brackets are of short steps and wider than the hit distance's own rounding, so a depth outside of its
//! bracket is wrong.

use glam::DVec3;
use mandelight::formula::mandelbulb::Mandelbulb;

use super::{
    arithmetic::Number,
    orbit::Estimate,
    rays::{SetView, Way},
};

/// Part of the hit distance within which a ray ends for certain.
const CERTAIN: f64 = 0.5;
/// Hit distances within which a ray may end.
const POSSIBLE: f64 = 2.0;
/// Part of the safe step that a step of the bracket's march covers.
const FINE: f64 = 0.25;
/// Part of the hit distance that such a step covers at least.
const FINEST: f64 = 0.01;
/// Longest such step within a footprint of a depth, in footprints: at the seam of a power that is not whole the estimate
/// falls from any height to nothing.
const FOOTPRINT_PART: f64 = 0.125;
/// Steps of the golden-section search, each of which shrinks the interval to 0.618 of itself.
const GOLDEN_SECTION_STEPS: u32 = 24;
/// The hit distances for which a ray must be near for its end to be certain: rays may pass what is thinner than their
/// least step.
const THICK: f64 = 0.25;
/// The same at powers below 4, whose hits must last.
const LASTING: f64 = 1.0;
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

impl<N: Number> SetView<'_, N> {
    /// Judges the depth that a picture has along a direction; none is a miss.
    pub fn judge(&self, direction: DVec3, found: Option<f64>) -> Verdict {
        if found.is_some_and(|depth| !self.is_near(direction, depth)) {
            return Verdict::TooNear;
        }
        let end = found.map_or(f64::INFINITY, |depth| depth - 2.0 * self.footprint(depth));
        match self.certain_depth(direction, end) {
            Some(_) => Verdict::TooFar,
            None => Verdict::Right,
        }
    }

    /// Whether a ray may end within a footprint of a depth.
    fn is_near(&self, direction: DVec3, depth: f64) -> bool {
        let (footprint, hit) = (self.footprint(depth), self.hit_distance(depth));
        let range = [depth - footprint, depth + footprint];
        let fine = |_, estimate: Estimate| {
            (FINE * estimate.step).min(FOOTPRINT_PART * footprint).max(FINEST * hit)
        };
        let mut least = (self.estimate(direction, depth).distance, depth);
        let ask = |depth, estimate: Estimate| {
            if estimate.distance < least.0 {
                least = (estimate.distance, depth);
            }
            (least.0 < POSSIBLE * hit).then_some(())
        };
        if let Way::Answered(()) = self.look_between(direction, range, fine, ask) {
            return true;
        }
        // At lower powers rays do not end at hairs: a hit has to last.
        let ends_at_hairs = Mandelbulb::of(self.fractal()).power >= 4.0;
        let width = FOOTPRINT_PART * footprint;
        let is_at_hair = |at: f64| self.least_about(direction, at, width) < POSSIBLE * hit;
        ends_at_hairs && (is_at_hair(least.1) || (least.1 != depth && is_at_hair(depth)))
    }

    /// The least estimate within `width` of a depth, by a golden-section search.
    ///
    /// Where an orbit stretches a direction a thousand times as much as its dr says, the estimate falls from hundreds of hit
    /// distances to 0 and rises again within a hundredth of one, beside a hair. Steps miss that minimum.
    fn least_about(&self, direction: DVec3, depth: f64, width: f64) -> f64 {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let at = |depth: f64| self.estimate(direction, depth).distance;
        let (mut from, mut to) = (depth - width, depth + width);
        let mut inner = [to - GOLDEN * (to - from), from + GOLDEN * (to - from)];
        let mut found = inner.map(at);
        for _ in 0..GOLDEN_SECTION_STEPS {
            if found[0] < found[1] {
                to = inner[1];
                inner = [to - GOLDEN * (to - from), inner[0]];
                found = [at(inner[0]), found[0]];
            } else {
                from = inner[0];
                inner = [inner[1], from + GOLDEN * (to - from)];
                found = [found[1], at(inner[1])];
            }
        }
        found[0].min(found[1])
    }

    /// The distance estimate over the hit distance, at a depth.
    pub fn nearness(&self, direction: DVec3, depth: f64) -> f64 {
        self.estimate(direction, depth).distance / self.hit_distance(depth)
    }

    /// The first depth below `end` at which no ray is still on its way.
    fn certain_depth(&self, direction: DVec3, end: f64) -> Option<f64> {
        let is_low = Mandelbulb::of(self.fractal()).power < 4.0;
        let is_certain = |depth: f64| {
            let thick = if is_low { LASTING } else { THICK } * self.hit_distance(depth);
            let mut asked = (1..=ASKED).map(|i| depth + thick * f64::from(i) / f64::from(ASKED));
            asked.all(|depth| self.nearness(direction, depth) < CERTAIN)
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
