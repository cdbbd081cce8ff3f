//! The mathematics and the kernels against an oracle: the thesis's formulas, written once more in
//! f64, plainly and without a look at `src/fractal` or the shaders.
//!
//! | file | what lives there |
//! |---|---|
//! | `estimate` | oracle: orbits, distance estimate, smooth iteration count, orbit traps |
//! | `rays` | oracle: camera rays, march, six-sample normals, shadow rays |
//! | `normals` | oracle: the estimate's gradient, by differences |
//! | `normals_table` | every way to find normals against that gradient, and the table of `docs/normals.md` |
//! | `light` | oracle: Blinn-Phong, the gradient, tone curve, sRGB |
//! | `tone` | oracle: the tone curves |
//! | `bloom` | oracle: light that spreads |
//! | `film` | films of any colours, given to the kernels |
//! | `quantile` | what part of many numbers lies below; the benchmark uses it too |
//! | `random` | numbers that come out the same each time |
//! | `views` | the views that pictures are compared on |
//! | `against_cpu` | `src/fractal` and `src/scene` against the oracle |
//! | `toned` | what the kernels make of a film, against the oracle |
//! | `against_gpu` | the kernels against the oracle, on whatever adapter there is |

mod against_cpu;
mod against_gpu;
mod bloom;
mod estimate;
mod film;
mod indirect;
mod light;
mod normals;
mod normals_table;
mod quantile;
mod random;
mod rays;
mod tone;
mod toned;
mod views;

pub use mandelight::gpu::device::in_parallel;
pub use random::Random;

/// The value below which `part` (0 to 1) of `values` lie.
pub fn quantile(values: Vec<f64>, part: f64) -> f64 {
    quantile::quantile(values, part).expect("a value")
}
