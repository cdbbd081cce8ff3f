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
//! | `axis` | the field in f64 hard by the polar axis against the march's estimates |
//! | `search` | how the views were found |

mod agree;
mod along;
mod arithmetic;
mod axis;
mod orbit;
mod rays;
mod search;
mod views;

#[expect(dead_code, reason = "of shallow views, which need more than distances")]
#[path = "../oracle/estimate.rs"]
mod estimate;
use mandelight::gpu::device::in_parallel;
#[path = "../oracle/quantile.rs"]
mod quantile;
#[path = "../oracle/random.rs"]
mod random;

pub use random::Random;
