//! What an integrator is.

use crate::render::{
    layouts::Layouts, recorder::Pass, schedule::Plan, targets::Targets, uniforms::Inputs,
};

/// Computes samples.
pub struct Integrator {
    /// A name, unique among integrators.
    pub name: &'static str,
    /// The passes, in the order of a frame.
    pub passes: &'static [&'static Pass],
    /// Where work on samples starts after an edit, and what the work costs.
    pub plan: &'static Plan,
    /// Allocates the buffers that only this integrator needs for a frame, and frees the buffers of others.
    pub fit_targets: fn(&mut Targets, &Layouts, &Inputs),
}
