//! What the tests and the benchmark share, compiled once.
//!
//! | module | contents |
//! |---|---|
//! | `device` | the one device of a test binary, and devices of one's own |
//! | `view` | short ways to a finished picture and its pixels |
//! | `beauty` | measures of pictures worth seeing |
//! | `compare` | two pictures, region by region |
//! | `expressions` | random formulas of the language |
//! | `histogram` | means and histograms of pictures |
//! | `patience` | how long tests wait |
//! | `picture` | what a PNG holds |
//! | `program` | the built program, run as a script runs it |
//! | `probe` | the formula's kernels at given points |
//! | `descent` | a person who only turns the wheel |
//! | `dives`, `stereo` | scenes of several tests |
//! | `oracle` | the thesis's formulas in f64, written without a look at `src/fractal` or the shaders |
//! | `deep` | the same with numbers of 192 bits, for views at any depth |
//! | `scenes`, `hostile` | any valid scene; scenes that are hard on the kernels |
//! | `random` | numbers that come out the same each time |
//! | `statistics` | quantiles |
//! | `variables` | numbers from environment variables, and new seeds |

pub mod beauty;
pub mod compare;
pub mod deep;
pub mod descent;
pub mod device;
pub mod dives;
pub mod expressions;
pub mod histogram;
pub mod hostile;
pub mod oracle;
pub mod patience;
pub mod picture;
pub mod probe;
pub mod program;
pub mod random;
pub mod scenes;
pub mod statistics;
pub mod stereo;
pub mod variables;
pub mod view;
