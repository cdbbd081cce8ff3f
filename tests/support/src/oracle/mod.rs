//! The oracle: the thesis's formulas, written once more in f64, plainly and without a look at
//! `src/fractal` or the shaders.
//!
//! | module | contents |
//! |---|---|
//! | `estimate` | orbits, distance estimate, smooth iteration count, orbit traps |
//! | `quaternion` | the quaternion Julia set, by Hamilton's product |
//! | `folds` | folds, turns and powers of several formulas |
//! | `formulas` | the formulas of `formulas/` |
//! | `transforms` | the transforms of hybrids |
//! | `orbits` | orbits of formulas and hybrids |
//! | `formula_rays` | rays toward the set of any formula, cut by section planes |
//! | `rays` | camera rays, march, six-sample normals, shadow rays |
//! | `normals` | the estimate's gradient, by differences |
//! | `light` | Blinn-Phong, the gradient of colours, sRGB |
//! | `tone` | the tone curves |
//! | `bloom` | light that spreads |
//! | `paths` | light paths from surface to surface |
//! | `views` | the views that pictures are compared on |

pub mod bloom;
pub mod estimate;
pub mod folds;
pub mod formula_rays;
pub mod formulas;
pub mod light;
pub mod normals;
pub mod orbits;
pub mod paths;
pub mod quaternion;
pub mod rays;
pub mod tone;
pub mod transforms;
pub mod views;
