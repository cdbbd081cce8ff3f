//! Integrators: how the light is computed that samples see. One file per integrator.
//!
//! An integrator computes samples for the film. The [schedule](super::schedule) chooses the samples, and the
//! passes of a [display](super::pass::DISPLAY) show the film, for every integrator. To add an integrator,
//! add its file, its list of passes in [`pass`](super::pass), and here its module.
//!
//! | file | contents |
//! |---|---|
//! | `contract` | what an integrator is |
//! | `direct` | the direct integrator |
//! | `path` | the path tracer |
//!
//! The buffers of [`Targets`](super::targets::Targets) that all integrators share:
//!
//! | buffer | contents |
//! |---|---|
//! | [`rays`](super::targets::Targets::rays) | a [`Ray`](super::uniforms::Ray) per sample of a batch: origin, direction, and the cone that the sample sees; a pass that moves or scatters the ray writes the ray there |
//! | [`work_queues`](super::targets::Targets::work_queues) | the blocks of samples, or the samples, that a pass has work for |
//! | [`center`](super::targets::Targets::center), [`jittered`](super::targets::Targets::jittered) | depth, normal, colour data and visibility of samples |
//! | [`film_rg`](super::targets::Targets::film_rg), [`film_bw`](super::targets::Targets::film_bw) | the sums of radiance and sample counts: the result |

mod contract;
mod direct;
mod path;

pub use contract::Integrator;
pub use direct::DIRECT;
pub use path::{PATH, PATH_IN_MEDIUM};

use super::uniforms::Inputs;

/// The integrator of a scene.
pub fn of(inputs: &Inputs) -> &'static Integrator {
    if inputs.traces_medium() {
        &PATH_IN_MEDIUM
    } else if inputs.traces_paths() {
        &PATH
    } else {
        &DIRECT
    }
}
