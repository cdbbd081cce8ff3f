//! Points whose orbits recur, and orbits with the derivatives that Newton's method needs.
//!
//! About a point whose orbit ends in a repelling cycle (a Misiurewicz point), the set repeats itself at every
//! scale. About a point whose orbit returns to the origin lies a small copy of the set.

use glam::{DMat3, DVec3};

/// An equation between two positions of an orbit. Positions count from 0, the point itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Recurrence {
    /// The orbit enters a cycle: its position `preperiod + period` is its position `preperiod`.
    Cycle {
        /// Number of positions before the cycle, at least 1.
        preperiod: usize,
        /// Number of positions of the cycle, at least 1.
        period: usize,
    },
    /// The orbit returns to the origin: its position `returns` is 0.
    Center {
        /// Number of steps until the orbit is at the origin, at least 1.
        returns: usize,
    },
}

impl Recurrence {
    /// Index of the last position that the equation names.
    pub fn last(self) -> usize {
        match self {
            Self::Cycle { preperiod, period } => preperiod + period,
            Self::Center { returns } => returns,
        }
    }

    /// The position that the last one has to equal; none if that is the origin.
    pub fn first(self) -> Option<usize> {
        match self {
            Self::Cycle { preperiod, .. } => Some(preperiod),
            Self::Center { .. } => None,
        }
    }
}

/// One position of an orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitPosition {
    /// The position, absolute also in fields about an anchor.
    pub z: DVec3,
    /// Derivative of `z` by the orbit's point.
    pub jacobian: DMat3,
    /// Derivative of the next position by `z`.
    pub step: DMat3,
}

/// The equation's error at an orbit, and the error's derivative by the orbit's point.
///
/// None if the orbit is too short.
pub fn residual(orbit: &[OrbitPosition], recurrence: Recurrence) -> Option<(DVec3, DMat3)> {
    let last = orbit.get(recurrence.last())?;
    let first = recurrence.first().map(|first| &orbit[first]);
    let (z, jacobian) = first.map_or((DVec3::ZERO, DMat3::ZERO), |it| (it.z, it.jacobian));
    Some((last.z - z, last.jacobian - jacobian))
}

/// The Frobenius norm of `matrix`: at least the length to which it maps any unit vector.
pub fn norm(matrix: &DMat3) -> f64 {
    matrix.to_cols_array().into_iter().map(|part| part * part).sum::<f64>().sqrt()
}
