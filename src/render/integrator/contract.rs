//! What an integrator is.

use crate::{
    render::{
        layouts::Layouts, recorder::Pass, schedule::Plan, targets::Targets, uniforms::Inputs,
    },
    scene::Scene,
};

/// Computes samples.
pub struct Integrator {
    /// The passes, in the order of a frame.
    pub passes: &'static [&'static Pass],
    /// Where work on samples starts after an edit, and what the work costs.
    pub plan: &'static Plan,
    /// Whether the centre samples of a scene wait for light gathered from their neighbours
    /// ([`Indirect`](crate::render::schedule::Points::Indirect)) before they count as filmed.
    pub gathers: fn(&Scene) -> bool,
    /// Allocates the buffers that only this integrator needs for a frame, and frees the buffers of others.
    pub fit_targets: fn(&mut Targets, &Layouts, &Inputs),
}
