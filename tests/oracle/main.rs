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
//! | `parallel` | work on all cores; the benchmark's references use it too |
//! | `views` | the views that pictures are compared on |
//! | `against_cpu` | `src/fractal` and `src/scene` against the oracle |
//! | `toned` | what the kernels make of a film, against the oracle |
//! | `against_gpu` | the kernels against the oracle, on whatever adapter there is |

mod against_cpu;
mod against_gpu;
mod bloom;
mod estimate;
mod film;
mod gather;
mod light;
mod normals;
mod normals_table;
mod parallel;
mod rays;
mod tone;
mod toned;
mod views;

pub use parallel::in_parallel;

/// A small generator of repeatable numbers (xorshift).
pub struct Random(pub u64);

impl Random {
    /// In 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly within the ball of `radius`, and never quite its centre.
    pub fn in_ball(&mut self, radius: f64) -> glam::DVec3 {
        loop {
            let v = glam::DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0;
            if (1e-3..=1.0).contains(&v.length()) {
                return v * radius;
            }
        }
    }
}

/// The value below which `part` (0 to 1) of `values` lie.
pub fn quantile(mut values: Vec<f64>, part: f64) -> f64 {
    assert!(!values.is_empty());
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * part) as usize]
}
