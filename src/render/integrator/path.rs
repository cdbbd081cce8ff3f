//! The path tracer: light that bounces between surfaces.
//!
//! Centre samples are those of direct light: a picture in motion shows them, and export takes their depths and normals.
//! Each jittered sample is a path. Its rays, and at each surface point one shadow ray to a light chosen by its share,
//! run through the march passes of direct light, or in a medium through `track`.

use super::{contract::Integrator, direct};
use crate::render::{
    pass,
    schedule::{GBufferValidity, Job, Plan, Points, SampleCost, Stage, WorkKind},
};

/// The path tracer. Own buffers: [`Targets::paths`](crate::render::targets::Targets::paths) and regions of samples in
/// [`Targets::work_queues`](crate::render::targets::Targets::work_queues).
pub static PATH: Integrator = Integrator {
    center_passes: pass::DIRECT,
    jittered_passes: pass::PATH,
    plan: &Plan { job, sample_cost },
    gathers: direct::DIRECT.gathers,
    fit_targets: |targets, layouts, inputs| {
        // Also keeps the direct picture, while paths take its place.
        targets.fit_direct(layouts, true);
        targets.fit_paths(layouts, true, inputs.sky.as_ref());
        targets.fit_denoiser(layouts, inputs.frame.paths.denoise != 0);
    },
};

/// The path tracer for sets that are a medium.
pub static PATH_IN_MEDIUM: Integrator =
    Integrator { jittered_passes: pass::PATH_IN_MEDIUM, ..PATH };

/// Jittered samples are paths, whose lights are chosen as they go.
fn job(points: Points, valid: &GBufferValidity, shining: u64) -> Job {
    match points {
        Points::Samples { .. } => Job { from: Stage::Path, lights: 0 },
        _ => (direct::DIRECT.plan.job)(points, valid, shining),
    }
}

/// A path counts as one ray, with a cost of its own.
fn sample_cost(job: Job, casting: u64) -> SampleCost {
    match job.from {
        Stage::Path => SampleCost { kind: WorkKind::Paths, rays: 1.0 },
        _ => (direct::DIRECT.plan.sample_cost)(job, casting),
    }
}
