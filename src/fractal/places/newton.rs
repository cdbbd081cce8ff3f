//! Newton's method for points whose orbits recur.

use glam::{DMat3, DVec3};

use super::spectrum::{condition, eigenvalue_moduli};
use crate::{
    formula::{DistanceField, OrbitPosition, Recurrence, recurrence::residual},
    scene::{Fractal, PrecisePoint},
};

/// Most rounds of Newton's method in f64: nearly all that converge need fewer.
const MAX_ROUNDS: u32 = 14;
/// Longest step of a round, as a part of the search's extent.
const MAX_STEP: f64 = 0.05;
/// Step below which a solution counts as found, as a part of the extent.
const CONVERGED: f64 = 1e-10;
/// Greatest distance between start and solution, as a part of the extent.
const MAX_DISTANCE: f64 = 0.25;
/// Most rounds of the refinement with many digits; each gains about ten digits.
const MAX_REFINEMENTS: u32 = 12;
/// Step below which a refined solution counts as exact, in scene units.
///
/// Far below the deepest view, so that a dive's end is not displaced.
const EXACT: f64 = 1e-45;
/// Least modulus of a repelling cycle's multiplier.
const REPELLING: f64 = 1.05;

/// A solution of a recurrence, with what decides how it looks at depth.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// The point, in the field's coordinates.
    pub point: DVec3,
    /// The equation that its orbit fulfils.
    pub recurrence: Recurrence,
    /// Derivative of the equation's error by the point.
    pub derivative: DMat3,
    /// Derivative of one turn: of the cycle, or of the orbit until it is at the origin.
    turn: DMat3,
}

impl Solution {
    /// How shapes are drawn out: `g = ln |λ₃| / ln |λ₁|` of the cycle's multiplier, at least 1.
    ///
    /// 1 is conformal: shapes keep their proportions. At scale s they are drawn out `s^(1/g − 1)` times.
    /// Infinite if the cycle does not repel; 1 for a small copy, which has a size.
    pub fn elongation(&self) -> f64 {
        if let Recurrence::Center { .. } = self.recurrence {
            return 1.0;
        }
        let [least, _, greatest] = eigenvalue_moduli(&self.turn);
        if least > REPELLING { greatest.ln() / least.ln() } else { f64::INFINITY }
    }

    /// Number of iterations until shapes of size `scale` about the point are as large as the set.
    ///
    /// 0 for a small copy, which has a size.
    pub fn iterations_to(&self, scale: f64) -> f64 {
        let Recurrence::Cycle { preperiod, period } = self.recurrence else { return 0.0 };
        let [least, ..] = eigenvalue_moduli(&self.turn);
        preperiod as f64 + period as f64 * -scale.ln() / least.max(REPELLING).ln()
    }

    /// How much a picture of the point is drawn out at every depth, at least 1.
    ///
    /// The surface around the point looks like that around its cycle, seen through the derivative. A small
    /// copy is the whole set, seen through the derivative and the turn.
    pub fn distortion(&self) -> f64 {
        match self.recurrence {
            Recurrence::Cycle { .. } => condition(&self.derivative),
            Recurrence::Center { .. } => condition(&self.derivative) * condition(&self.turn),
        }
    }
}

/// The solution of `recurrence` near `start`; none if Newton's method does not find one.
///
/// `extent` is the height of the view there, in scene units.
pub fn solve(
    field: &dyn DistanceField,
    start: DVec3,
    recurrence: Recurrence,
    extent: f64,
) -> Option<Solution> {
    let mut point = start;
    for _ in 0..MAX_ROUNDS {
        let orbit = field.orbit(point, recurrence.last() + 1);
        let (error, derivative) = residual(&orbit, recurrence)?;
        let step = newton_step(error, derivative)?;
        point -= step.clamp_length_max(MAX_STEP * extent);
        if point.distance(start) > MAX_DISTANCE * extent {
            return None;
        }
        if step.length() < CONVERGED * extent {
            let turn = turn(&orbit, recurrence);
            return Some(Solution { point, recurrence, derivative, turn });
        }
    }
    None
}

/// The exact point of a solution, found in steps.
///
/// Every round with the derivative of the solution in f64 gains about ten digits.
pub struct Refinement {
    fractal: Fractal,
    point: PrecisePoint,
    recurrence: Recurrence,
    derivative: DMat3,
    rounds: u32,
}

/// What a round of a [`Refinement`] found.
pub enum Refined {
    /// More rounds are necessary.
    Unfinished,
    /// The exact point.
    Exact(PrecisePoint),
    /// The steps do not become tiny.
    Diverging,
}

impl Refinement {
    /// A refinement of a solution near `guess`, which has the equation `recurrence`.
    ///
    /// `derivative` is that of the solution in f64.
    pub fn new(
        fractal: &Fractal,
        guess: PrecisePoint,
        recurrence: Recurrence,
        derivative: DMat3,
    ) -> Self {
        Self { fractal: fractal.clone(), point: guess, recurrence, derivative, rounds: 0 }
    }

    /// Runs one round. A point of a fractal without depth stays as it is.
    pub fn step(&mut self) -> Refined {
        let formula = self.fractal.formula();
        if !formula.has_depth(&self.fractal) {
            return Refined::Exact(self.point.clone());
        }
        let error = formula.recurrence_error(&self.fractal, &self.point, self.recurrence);
        let step = error.and_then(|error| newton_step(error, self.derivative));
        let Some(step) = step.filter(|_| self.rounds < MAX_REFINEMENTS) else {
            return Refined::Diverging;
        };
        self.rounds += 1;
        // Two digits more than are needed keep the document's numbers short.
        self.point = self.point.moved_by(-step, 0.01 * EXACT);
        if step.length() < EXACT {
            return Refined::Exact(self.point.clone());
        }
        Refined::Unfinished
    }
}

fn newton_step(error: DVec3, derivative: DMat3) -> Option<DVec3> {
    let inverse = (derivative.determinant() != 0.0).then(|| derivative.inverse())?;
    Some(inverse * error).filter(|step| step.is_finite())
}

/// Derivative of one turn of the cycle, or of the steps until the orbit is at the origin.
fn turn(orbit: &[OrbitPosition], recurrence: Recurrence) -> DMat3 {
    let first = recurrence.first().unwrap_or(0);
    orbit[first..recurrence.last()]
        .iter()
        .fold(DMat3::IDENTITY, |turn, position| position.step * turn)
}
