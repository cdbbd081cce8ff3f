//! Perturbation: the fractal near an anchor, at any depth.
//!
//! An f64 resolves a point to 10⁻¹⁶ of a scene unit, an f32 to 10⁻⁷. The difference between two points'
//! orbits can be followed far more finely ([`difference`]), if one of the orbits, the reference orbit,
//! is computed with enough digits ([`orbit`]). The idea is K. I. Martin's, "Superfractalthing
//! maths" (2013), for the Mandelbrot set. When the difference grows as large as the orbit, it
//! restarts from the reference orbit's start (rebasing), so that no point needs another reference.
//!
//! | file | contents |
//! |---|---|
//! | [`iterations`] | how many iterations views need |
//! | [`orbit`] | reference orbits, to 256 bits |
//! | [`difference`] | one step of the difference between two orbits |
//! | [`rotating_frame`] | frames that rotate with a point's longitude, for even powers near the polar axis |
//! | [`jet`] | numbers with first and second derivatives |
//! | [`series`] | polynomials that replace the first steps of all orbits of a view |
//! | [`jacobian`] | derivatives of deep orbits by their point |
//! | [`reference`](mod@reference) | an anchor and its orbit |
//! | [`field`] | the distance field about an anchor |

pub mod difference;
pub mod field;
pub mod iterations;
pub mod jacobian;
pub mod jet;
pub mod orbit;
pub mod reference;
pub mod rotating_frame;
pub mod series;

pub use field::{CLOSE, DeepField};
pub use iterations::{FINEST_FOOTPRINT, iterations_for};
pub use orbit::ReferencePoint;
pub use reference::{Reference, reference_of};

pub use series::SeriesApproximation;
