//! One pass a file, with the stem of its shader in `shaders/pass/`: which files its module is
//! joined from, and how it is dispatched.

use crate::gpu::shader::Module;

pub mod bloom;
pub mod blur;
pub mod cone;
pub mod develop;
pub mod expose;
pub mod fill;
pub mod histogram;
pub mod hits;
pub mod indirect;
pub mod march;
pub mod mean;
pub mod normal;
pub mod probe;
pub mod reduce;
pub mod shade;
pub mod shadow;
pub mod spread;
pub mod tone;
pub mod tube;

/// Every shader module of the program.
pub const MODULES: &[&Module] = &[
    &cone::MODULE,
    &march::MODULE,
    &hits::MODULE,
    &normal::MODULE,
    &tube::MODULE,
    &shadow::MODULE,
    &shade::MODULE,
    &indirect::MODULE,
    &fill::MODULE,
    &develop::MODULE,
    &spread::MODULE,
    &mean::MODULE,
    &reduce::MODULE,
    &expose::MODULE,
    &histogram::MODULE,
    &bloom::MODULE,
    &blur::MODULE,
    &tone::MODULE,
    &probe::MODULE,
];
