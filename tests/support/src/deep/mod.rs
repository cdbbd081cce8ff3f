//! Views at any depth by a march with numbers of 192 bits, written from the thesis's formulas
//! without a look at `src/fractal` or the shaders.
//!
//! | module | contents |
//! |---|---|
//! | `arithmetic` | real and complex numbers: f64, and of 192 bits |
//! | `brackets` | the depths that a ray may end at |
//! | `orbit` | distance estimates, and how far rays may step |
//! | `random_views` | views of random places at random depths |
//! | `rays` | camera rays from an eye at any depth, hits, normals |
//! | `views` | anchors on the surface, and from where they are looked at |

pub mod arithmetic;
pub mod brackets;
pub mod orbit;
pub mod random_views;
pub mod rays;
pub mod views;
