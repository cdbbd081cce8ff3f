//! What an integrator is.

use crate::{
    render::{
        layouts::Layouts, recorder::Pass, schedule::Plan, targets::Targets, uniforms::Inputs,
    },
    scene::Scene,
};

/// Computes samples.
pub struct Integrator {
    /// The passes of centre samples, in the order of a frame.
    pub center_passes: &'static [&'static Pass],
    /// The passes of jittered samples, in the order of a frame.
    pub jittered_passes: &'static [&'static Pass],
    /// Where work on samples starts after an edit, and what the work costs.
    pub plan: &'static Plan,
    /// Whether centre samples wait for light from their neighbours before they are filmed.
    ///
    /// If so, the schedule asks for [`Indirect`](crate::render::schedule::Points::Indirect) points.
    pub gathers: fn(&Scene) -> bool,
    /// Allocates the buffers that only this integrator needs; frees those of others.
    pub fit_targets: fn(&mut Targets, &Layouts, &Inputs),
}
