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
    pub sample_cost: fn(Job, u64) -> SampleCost,
}

/// What a job costs for each of its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleCost {
    /// Kind of work.
    pub kind: WorkKind,
    /// How many rays a sample counts as.
    pub rays: f64,
}

/// A kind of work; each kind has measured costs of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// Marching of rays.
    Tracing,
    /// Tracing of light paths.
    Paths,
    /// Shading alone.
    Shading,
    /// Gathering of indirect light.
    Indirect,
}
