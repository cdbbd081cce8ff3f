//! The kernels against the oracle in f64.
//!
//! | file | what it tests |
//! |---|---|
//! | `formulas` | estimates, gradients and colours of the formulas of `formulas/` |
//! | `formula_views` | hits, depths and normals of two views of each of these formulas |
//! | `layers` | colour channels and orbit traps |
//! | `sections` | section planes: the slice, its normals, colours and light |
//! | `points` | estimates and gradients at random points, on the axis and inside |
//! | `pictures` | hits, normals, shadows and shading of whole views |
//! | `normals_table` | every way to find normals, and the table of `docs/normals.md` |
//! | `indirect` | indirect light on sample points that were made up |
//! | `toned` | what the kernels make of a film |
//! | `film` | no test: films of any colours, given to the kernels |

mod film;
mod formula_views;
mod formulas;
mod indirect;
mod layers;
mod normals_table;
pub mod pictures;
mod points;
mod sections;
mod toned;
