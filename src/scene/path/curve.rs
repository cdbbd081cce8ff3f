//! Smooth curves through keys, in any space with geodesics (shortest lines).
//!
//! In: the two keys around a time and their neighbours. Out: the point between the two keys. The
//! curves are cubic Bézier curves in which de Casteljau's construction runs along geodesics
//! instead of straight lines (Shoemake 1985, "Animating rotation with quaternion curves", for
//! rotations). In every space, the control points determine the velocity at both ends. So one
//! construction serves numbers, zoom positions and rotations.

use glam::DVec4;

/// A space of points with a geodesic between any two.
pub trait Space {
    /// A point of the space.
    type Point: Clone;

    /// The point at `part`, 0 to 1, of the geodesic from `a` to `b`.
    fn between(&self, a: &Self::Point, b: &Self::Point, part: f64) -> Self::Point;

    /// The logarithm map: the velocity at `a` that reaches `b` after unit time.
    fn velocity(&self, a: &Self::Point, b: &Self::Point) -> DVec4;

    /// The exponential map: the point after unit time, from `a` with `velocity`.
    fn after(&self, a: &Self::Point, velocity: DVec4) -> Self::Point;
}

/// The condition on a curve's velocity at a key.
///
/// `secs` is the duration, in seconds, of the span on the other side of the key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// The velocity is zero.
    Rest,
    /// The velocity is a mean of both sides' velocities.
    Through { secs: f64 },
    /// The velocity is the constant velocity of the other side.
    Along { secs: f64 },
}

impl Joint {
    fn secs(self) -> Option<f64> {
        match self {
            Self::Rest => None,
            Self::Through { secs } | Self::Along { secs } => Some(secs),
        }
    }
}

/// The time span between two keys, and a time within the span.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// The elapsed fraction of the span, 0 to 1.
    pub part: f64,
    /// True if the speed is constant.
    pub is_linear: bool,
    /// The span's duration, seconds.
    pub secs: f64,
    /// The condition at the span's start.
    pub before: Joint,
    /// The condition at the span's end.
    pub after: Joint,
}

impl Span {
    /// The point of `space` at this time, between the second and the third of `keys`.
    ///
    /// The first and the fourth key are the neighbours; they may be missing.
    pub fn point<S: Space>(&self, space: &S, keys: [Option<&S::Point>; 4]) -> Option<S::Point> {
        let [before, from, to, after] = keys;
        let (from, to) = (from?, to?);
        if self.is_linear {
            return Some(space.between(from, to, self.part));
        }
        let leaving = self.velocity_at_key(
            self.before,
            before.map(|before| -space.velocity(from, before)),
            space.velocity(from, to),
        );
        let arriving = self.velocity_at_key(
            self.after,
            after.map(|after| space.velocity(to, after)),
            -space.velocity(to, from),
        );
        let third = self.secs / 3.0;
        let controls = [
            from.clone(),
            space.after(from, leaving * third),
            space.after(to, -arriving * third),
            to.clone(),
        ];
        Some(bezier(space, &controls, self.part))
    }

    /// The velocity at a key, per second.
    ///
    /// `beyond` and `here` are the displacements over the other span and over this span.
    fn velocity_at_key(&self, joint: Joint, beyond: Option<DVec4>, here: DVec4) -> DVec4 {
        let (Some(beyond), Some(secs)) = (beyond, joint.secs()) else {
            return DVec4::ZERO;
        };
        match joint {
            Joint::Along { .. } => beyond / secs,
            _ => harmonic_mean(beyond / secs, here / self.secs),
        }
    }
}

/// The harmonic mean of two velocities, along the sum of their directions.
///
/// The mean's length is at most twice the shorter length, so a number never overshoots a key
/// (Fritsch and Butland 1984). A zero velocity, or opposite velocities, give zero.
fn harmonic_mean(a: DVec4, b: DVec4) -> DVec4 {
    let (fast, slow) = (a.length(), b.length());
    if fast == 0.0 || slow == 0.0 {
        return DVec4::ZERO;
    }
    (a / fast + b / slow) * (fast * slow / (fast + slow))
}

/// The cubic Bézier curve of four control points, by de Casteljau's construction.
fn bezier<S: Space>(space: &S, controls: &[S::Point; 4], part: f64) -> S::Point {
    let [a, b, c, d] = controls;
    let (ab, bc, cd) =
        (space.between(a, b, part), space.between(b, c, part), space.between(c, d, part));
    let (abc, bcd) = (space.between(&ab, &bc, part), space.between(&bc, &cd, part));
    space.between(&abc, &bcd, part)
}

/// The space of real numbers.
pub struct Line;

impl Space for Line {
    type Point = f64;

    fn between(&self, a: &f64, b: &f64, part: f64) -> f64 {
        // Rounding must not change a number that both keys share.
        if a == b { *a } else { a * (1.0 - part) + b * part }
    }

    fn velocity(&self, a: &f64, b: &f64) -> DVec4 {
        DVec4::new(b - a, 0.0, 0.0, 0.0)
    }

    fn after(&self, a: &f64, velocity: DVec4) -> f64 {
        a + velocity.x
    }
}
