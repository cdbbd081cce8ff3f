//! The fractal's mathematics on the CPU, in f64: what picking, speed and collision need.
//!
//! In: a [`Fractal`](crate::scene::Fractal) and points in scene units. Out: distances, hits
//! and normals. This layer knows no GPU and no user interface; the kernels in `shaders/`
//! follow the same formulas, and tests hold both to an oracle written from the thesis.
//!
//! | file | what lives there |
//! |---|---|
//! | [`power`] | zⁿ, without trigonometry where n is a whole number |
//! | [`estimator`] | the distance estimate (thesis Algorithm 1), its safe step, the bounding sphere |
//! | [`deep`] | the set about an anchor, at any depth: perturbation |
//! | [`march`] | rays against any [`DistanceField`], normals, what lies under a pixel |

pub mod deep;
pub mod estimator;
pub mod march;
pub mod power;

pub use deep::{DeepField, Reference};
pub use estimator::Estimator;
pub use march::{
    DEEP_FOOTPRINT, DistanceField, Estimate, LEAST_STEP, MAX_MARCH_STEPS, PLAIN_FOOTPRINT, Ray,
    camera_ray, pixel_cone,
};
