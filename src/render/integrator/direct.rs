//! The direct integrator: light straight from the lights, and indirect light gathered on the screen.
//!
//! Per sample: a camera ray to the surface, a normal, a shadow ray per light, the light that the surface
//! reflects (thesis 3.2 and 4.5).

use super::contract::Integrator;
use crate::{
    render::{
        pass,
        schedule::{GBufferValidity, Job, Plan, Points, SampleCost, Stage, WorkKind},
    },
    scene::Scene,
};

/// The direct integrator. Own buffer: [`Targets::direct`](crate::render::targets::Targets::direct).
pub static DIRECT: Integrator = Integrator {
    center_passes: pass::DIRECT,
    jittered_passes: pass::DIRECT,
    plan: &Plan { job, sample_cost },
    gathers: Scene::has_indirect,
    fit_targets: |targets, layouts, inputs| {
        targets.fit_direct(layouts, inputs.has_indirect());
        targets.fit_paths(layouts, false, None);
        targets.fit_denoiser(layouts, false);
    },
};

/// Centre samples start after the stages whose results the G-buffer still holds.
fn job(points: Points, valid: &GBufferValidity, shining: u64) -> Job {
    let (from, lights) = match points {
        Points::Level(level) | Points::Added(level) => valid.first_missing(level, shining),
        Points::All => valid.first_missing(0, shining),
        Points::Indirect(_) => (Stage::Indirect, 0),
        Points::Samples { .. } => (Stage::March, shining),
    };
    Job { from, lights }
}

/// The cost of a sample, in rays.
///
/// Most of the work is shadow rays: costs learned with some lights hold well enough with others.
fn sample_cost(job: Job, casting: u64) -> SampleCost {
    let lights = f64::from((job.lights & casting).count_ones());
    let (kind, rays) = match job.from {
        Stage::Path | Stage::March | Stage::Normal => (WorkKind::Tracing, 1.0 + lights),
        Stage::Shadow if lights > 0.0 => (WorkKind::Tracing, lights),
        Stage::Shadow | Stage::Shade => (WorkKind::Shading, 1.0),
        Stage::Indirect => (WorkKind::Indirect, 1.0),
    };
    SampleCost { kind, rays }
}
