//! The uniforms of path tracing.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::{
    Light, PathTracing,
    background::{world_from_map, world_from_rig},
    lights,
};
use crate::{
    render::{sky::SampledSky, space::RenderSpace},
    scene::{Rig, RigKind, Scene, follow},
};

/// Length of rays without a limit, in render space.
const UNLIMITED: f64 = 1e30;

/// The path tracer's uniforms without a sky: its default if the scene's light paths are not traced.
pub fn paths(scene: &Scene, space: &RenderSpace) -> PathTracing {
    if !scene.traces_paths() {
        return PathTracing::default();
    }
    let table = lights::lights(scene, space);
    let count = follow::effective(&scene.lights, &scene.camera).len();
    let view_unit = scene.camera.view_unit() / space.scale();
    let reach = scene.integrator.reach.map_or(UNLIMITED, |reach| reach * view_unit).min(UNLIMITED);
    PathTracing {
        bounces: scene.integrator.bounces,
        light_count: count as u32,
        reach: reach as f32,
        noise: scene.integrator.noise as f32,
        denoise: scene.denoises().into(),
        firefly_limit: scene.integrator.firefly_limit.unwrap_or(0.0) as f32,
        ray_reach: table[..count].iter().map(reach_of).fold(reach as f32, f32::max),
        ..PathTracing::default()
    }
}

/// Length of the rays that may see a light: those toward lights with a size, which surfaces block.
fn reach_of(light: &Light) -> f32 {
    if light.size > 0.0 && light.casts_shadows != 0 { light.shadow_reach } else { 0.0 }
}

/// Replaces the rig's lights by the sky that they stand for, with a sun if the sky is a gradient.
pub fn add_sky(paths: &mut PathTracing, scene: &Scene, space: &RenderSpace, sky: &SampledSky) {
    let shining = follow::effective(&scene.lights, &scene.camera);
    let rig = &shining.rig;
    paths.light_count -= rig.len() as u32;
    if !rig.shines(shining.any_solo()) {
        return;
    }
    let view_unit = scene.camera.view_unit() / space.scale();
    let reach = rig.shadow_reach.map_or(UNLIMITED, |reach| reach * view_unit).min(UNLIMITED);
    // Surfaces beyond the paths' reach are not met: they hide no sky.
    let reach = if rig.casts_shadows && scene.quality.shadows {
        paths.reach.min(reach as f32)
    } else {
        0.0
    };
    let world_from_sky = match rig.kind {
        RigKind::EnvironmentMap => world_from_map(scene),
        RigKind::Sky | RigKind::None => world_from_rig(scene),
    };
    let axis = |axis: DVec3| (world_from_sky * axis).as_vec3().to_array();
    [paths.sky_x, paths.sky_y, paths.sky_z] = [DVec3::X, DVec3::Y, DVec3::Z].map(axis);
    paths.sky_gain = rig.intensity as f32;
    paths.sky_importance = (0.5 * rig.intensity * sky.energy() / PI) as f32;
    paths.sky_reach = reach;
    if rig.kind == RigKind::Sky {
        paths.sun = sun(rig, world_from_sky, reach);
    }
    paths.ray_reach = paths.ray_reach.max(reach).max(reach_of(&paths.sun));
}

fn sun(rig: &Rig, world_from_rig: DQuat, reach: f32) -> Light {
    let strength = rig.sky.sun_strength * rig.intensity;
    Light {
        vector: (world_from_rig * DVec3::from_array(rig.sky.sun_direction)).as_vec3().to_array(),
        color: rig.sky.sun_color.map(|channel| channel * strength as f32),
        casts_shadows: u32::from(reach > 0.0),
        shadow_reach: reach,
        size: (0.5 * rig.sky.sun_size_deg).to_radians().sin() as f32,
        ..Light::default()
    }
}
