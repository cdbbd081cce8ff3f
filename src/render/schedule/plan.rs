//! What a schedule knows of an integrator: where work starts, and what the work costs.

use super::{
    gbuffer_validity::GBufferValidity,
    work::{Job, Points},
};

/// Where an integrator's work on samples starts, and what the work costs.
#[derive(Debug)]
pub struct Plan {
    /// What must be done for some points.
    ///
    /// In: the points, what the G-buffer holds, the visibility bits of the lights that shine.
    pub job: fn(Points, &GBufferValidity, u64) -> Job,
    /// What a job costs for each of its samples.
    ///
    /// In: the job, the visibility bits of the lights that cast shadows.
    pub price: fn(Job, u64) -> Price,
}

/// What a job costs for each of its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Price {
    /// What the rays are: kinds have measured costs of their own.
    pub kind: WorkKind,
    /// How many rays a sample counts as.
    pub rays: f64,
}

/// What the rays of a job are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// Rays that are marched.
    Tracing,
    /// Samples that are shaded only.
    Shading,
    /// Samples that gather indirect light.
    Indirect,
}
