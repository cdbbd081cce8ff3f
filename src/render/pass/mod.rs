//! One file per pass, named like its shader in `shaders/pass/`.
//!
//! Each file declares what the pass binds, when a frame has the pass, and how it is dispatched. To add a
//! pass, add its two files, and here its module and its entry in [`PASSES`].

pub mod bloom;
pub mod blur;
pub mod camera_cone;
pub mod camera_rays;
pub mod compact_hits;
pub mod expose;
pub mod fill;
pub mod histogram;
pub mod indirect;
pub mod march;
pub mod mean;
pub mod normal;
pub mod reduce;
pub mod shade;
pub mod shadow;
pub mod shadow_cone;
pub mod tone;
pub mod tonemap_sparse;
pub mod upsample;

pub use super::recorder::{ONE_MODE, Pass, Record};

/// Every pass, in the order in which a frame has them; `Within` passes run inside the pass that records them.
pub const PASSES: &[&Pass] = &[
    // Sample points: rays to the surface, normals, shadows, light.
    &camera_rays::PASS,
    &camera_cone::PASS,
    &march::PASS,
    &compact_hits::PASS,
    &normal::PASS,
    &shadow_cone::PASS,
    &shadow::PASS,
    &shade::PASS,
    &indirect::PASS,
    // A display picture of a sparse lattice's samples alone.
    &tonemap_sparse::PASS,
    &upsample::PASS,
    // A display picture of the film.
    &fill::PASS,
    &mean::PASS,
    &reduce::PASS,
    &histogram::PASS,
    &expose::PASS,
    &bloom::PASS,
    &blur::PASS,
    &tone::PASS,
];
