//! The fractal near one of its points, at any depth: everything is measured from an anchor.
//!
//! An f64 places a point to 10⁻¹⁶ of the scene's unit, an f32 to 10⁻⁷. The difference of two points'
//! orbits can be followed much closer than that ([`difference`]), as long as one of the orbits, the
//! reference, is known to enough digits ([`orbit`]). The idea is K. I. Martin's, "Superfractalthing
//! maths" (2013), for the Mandelbrot set. Where the difference has grown as large as the orbit, it
//! starts anew from the orbit's own beginning (rebasing), so that no point needs another reference.
//!
//! | file | what lives there |
//! |---|---|
//! | [`orbit`] | reference orbits, to 256 bits |
//! | [`difference`] | one step of the difference between two orbits |
//! | [`rotating_frame`] | frames that turn with a point's longitude, for even powers by the polar axis |
//! | [`jet`] | numbers with first and second derivatives |
//! | [`series`] | the first steps of all orbits of a view at once |
//! | [`jacobian`] | how orbits move with their point |
//! | [`reference`] | an anchor with its orbit |
//! | [`field`] | the distance field about an anchor |
//! | [`search`] | the anchor of a view |

pub mod difference;
pub mod field;
pub mod jacobian;
pub mod jet;
pub mod orbit;
pub mod reference;
pub mod rotating_frame;
pub mod search;
pub mod series;

pub use field::{CLOSE, DeepField};
pub use orbit::ReferencePoint;
pub use reference::Reference;

pub use search::Search;
pub use series::SeriesApproximation;

use crate::scene::Fractal;

/// Views whose pixels are smaller than this at the nearest surface, in scene units, are drawn from
/// an anchor where that can be: coarser ones f32 draws as well.
pub const COARSEST_FOOTPRINT: f64 = 4e-7;
/// The finest pixel at the nearest surface, in scene units: below, f32 has no exponents left.
pub use crate::fractal::march::DEEP_FOOTPRINT as FINEST_FOOTPRINT;

/// A footprint whose view needs no more iterations than the scene says, in scene units.
const WHOLE_FOOTPRINT: f64 = 1e-3;

/// Whether a set can be drawn from an anchor: whole powers only.
pub fn has_depth(fractal: &Fractal) -> bool {
    fractal.integer_power().is_some()
}

/// Iterations of a view whose pixels have this radius at the nearest surface, in scene units: the
/// scene's own number, and as many more as orbits take to tell such points apart.
pub fn iterations_for(fractal: &Fractal, footprint: f64) -> u32 {
    let finer = (WHOLE_FOOTPRINT / footprint.max(0.1 * FINEST_FOOTPRINT)).max(1.0).ln();
    let more = (steps_per_power(fractal.power) * finer / fractal.power.ln()).ceil();
    fractal.iterations + more as u32
}

/// In how many steps points of this power's set are told apart by the power as a factor: where r < 1
/// by less than it in one. The most of 99 of 100 points of lines toward the surface, measured to 10⁻³².
fn steps_per_power(power: f64) -> f64 {
    1.2 + 3.0 / power
}
