//! The deepest views by a march with numbers of 256 bits, written from the thesis's formulas
//! without a look at `src/fractal` or the shaders.
//!
//! | module | contents |
//! |---|---|
//! | `arithmetic` | real and complex numbers of 256 bits |
//! | `orbit` | distance estimates, and how far rays may step |
//! | `rays` | camera rays from an eye at any depth, hits, normals |
//! | `views` | anchors on the surface, and from where they are looked at |

pub mod arithmetic;
pub mod orbit;
pub mod rays;
pub mod views;
