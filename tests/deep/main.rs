//! The deepest views against a march with numbers of 256 bits, written from the thesis's formulas
//! without a look at `src/fractal` or the shaders.
//!
//! | file | what lives there |
//! |---|---|
//! | `arithmetic` | real and complex numbers of 256 bits |
//! | `orbit` | distance estimates, and how far rays may step |
//! | `rays` | camera rays from an eye at any depth, hits, normals |
//! | `views` | anchors on the surface, and from where they are looked at |
//! | `agree` | the renderer's pictures against the march |
//! | `along` | the kernels' estimates along rays against the march's |
//! | `search` | how the views were found |

mod agree;
mod along;
mod arithmetic;
mod orbit;
mod rays;
mod search;
mod views;

#[expect(dead_code, reason = "of shallow views, which need more than distances")]
#[path = "../oracle/estimate.rs"]
mod estimate;
#[path = "../oracle/parallel.rs"]
mod parallel;

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
