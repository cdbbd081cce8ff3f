//! One pass a file, with the stem of its shader in `shaders/pass/`: which files its module is
//! joined from, and how it is dispatched.

use crate::gpu::shader::Module;

pub mod fill;
pub mod march;
pub mod probe;
pub mod shade;
pub mod shadow;
pub mod tone;

/// Every shader module of the program.
pub const MODULES: &[&Module] = &[
    &march::MODULE,
    &shadow::MODULE,
    &shade::MODULE,
    &fill::MODULE,
    &tone::MODULE,
    &probe::MODULE,
];
