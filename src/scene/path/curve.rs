//! Smooth curves through keys, in any space that has shortest lines.
//!
//! In: the two keys around a time and their neighbours. Out: the point between. A cubic Bézier
//! curve whose straight lines are the space's shortest lines (de Casteljau's construction, as
//! Shoemake 1985, "Animating rotation with quaternion curves", has it for rotations) begins and
//! ends with the velocity that its control points say, in every space alike. So one rule serves
//! numbers, places and turns.

use glam::DVec4;

/// A space of points with a shortest line between any two.
pub trait Space {
    /// A point.
    type Point: Clone;

    /// The point at `part`, 0 to 1, of the shortest line from `a` to `b`.
    fn between(&self, a: &Self::Point, b: &Self::Point, part: f64) -> Self::Point;

    /// The velocity at `a` of the shortest line that reaches `b` after unit time.
    fn velocity(&self, a: &Self::Point, b: &Self::Point) -> DVec4;

    /// The end of the shortest line that leaves `a` with `velocity`, after unit time.
    fn after(&self, a: &Self::Point, velocity: DVec4) -> Self::Point;
}

/// What a curve does where it meets a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// It comes to rest there.
    Rest,
    /// It goes through with a velocity between those of both sides; the other side takes so
    /// many seconds.
    Through { secs: f64 },
    /// It takes over the constant velocity of the other side.
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

/// The stretch between two keys, and where in it a time lies.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// The part of its time that has passed, 0 to 1.
    pub part: f64,
    /// Whether it is gone through at one speed.
    pub is_linear: bool,
    /// How long it takes, seconds.
    pub secs: f64,
    /// How it begins.
    pub before: Joint,
    /// How it ends.
    pub after: Joint,
}

impl Span {
    /// The point of `space` at this place between the second and the third of `keys`; the first
    /// and the last are their neighbours, where there are any.
    pub fn point<S: Space>(&self, space: &S, keys: [Option<&S::Point>; 4]) -> Option<S::Point> {
        let [before, from, to, after] = keys;
        let (from, to) = (from?, to?);
        if self.is_linear {
            return Some(space.between(from, to, self.part));
        }
        let leaving = self.joined(
            self.before,
            before.map(|before| -space.velocity(from, before)),
            space.velocity(from, to),
        );
        let arriving = self.joined(
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

    /// The velocity at a key, per second, from the ways on its other side and on this one.
    fn joined(&self, joint: Joint, beyond: Option<DVec4>, here: DVec4) -> DVec4 {
        let (Some(beyond), Some(secs)) = (beyond, joint.secs()) else {
            return DVec4::ZERO;
        };
        match joint {
            Joint::Along { .. } => beyond / secs,
            _ => through(beyond / secs, here / self.secs),
        }
    }
}

/// A velocity between two. Its length is their harmonic mean, never more than twice the lesser:
/// a number then never overshoots a key (Fritsch and Butland 1984), and what rests on one side
/// comes to rest. Opposite velocities give none.
fn through(a: DVec4, b: DVec4) -> DVec4 {
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

/// The plain numbers.
pub struct Line;

impl Space for Line {
    type Point = f64;

    fn between(&self, a: &f64, b: &f64, part: f64) -> f64 {
        // The same number at both ends stays that number.
        if a == b { *a } else { a * (1.0 - part) + b * part }
    }

    fn velocity(&self, a: &f64, b: &f64) -> DVec4 {
        DVec4::new(b - a, 0.0, 0.0, 0.0)
    }

    fn after(&self, a: &f64, velocity: DVec4) -> f64 {
        a + velocity.x
    }
}
