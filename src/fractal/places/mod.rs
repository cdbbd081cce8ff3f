//! Places: points of the surface that stay beautiful at every depth.
//!
//! A step of an orbit draws shapes out. About most points the surface is parallel streaks from a thousandfold
//! zoom on. About a point whose orbit ends in a repelling cycle (a Misiurewicz point) the surface repeats
//! itself, and if the cycle's multiplier is nearly conformal, it keeps its proportions down to any depth.
//! Newton's method finds such points from the surface points of a picture.
//!
//! | file | contents |
//! |---|---|
//! | `spectrum` | eigenvalues of 3×3 matrices |
//! | [`newton`] | points whose orbits recur |
//! | [`vantage`] | where to look at a place from |
//! | `probe` | the space about a place |
//! | [`find`] | the search for the places of a view |

pub mod find;
pub mod newton;
mod probe;
mod spectrum;
pub mod vantage;

pub use find::{Place, PlaceSearch, SearchArea};
pub use vantage::{CameraSearch, Vantage};
