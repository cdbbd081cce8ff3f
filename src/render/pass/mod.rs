//! One pass a file, with the stem of its shader in `shaders/pass/`: which files its module is
//! joined from, and how it is dispatched.

use crate::gpu::shader::Module;

pub mod bloom;
pub mod blur;
pub mod camera_cone;
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

/// Every shader module of the program.
pub const MODULES: &[&Module] = &[
    &camera_cone::MODULE,
    &march::MODULE,
    &compact_hits::MODULE,
    &normal::MODULE,
    &shadow_cone::MODULE,
    &shadow::MODULE,
    &shade::MODULE,
    &indirect::MODULE,
    &fill::MODULE,
    &tonemap_sparse::MODULE,
    &upsample::MODULE,
    &mean::MODULE,
    &reduce::MODULE,
    &expose::MODULE,
    &histogram::MODULE,
    &bloom::MODULE,
    &blur::MODULE,
    &tone::MODULE,
];
