//! The uniforms of the background.

use glam::{DQuat, DVec3};

use super::Background;
use crate::scene::{BackgroundKind, EnvironmentMap, LightFrame, Scene};

/// The scene's background: the gradient, until [`shown`] finds the environment map.
pub fn background(scene: &Scene) -> Background {
    let world_from_map = match scene.background.kind {
        BackgroundKind::EnvironmentMap => world_from_map(scene),
        // The orientation of a map that is not shown must not make the shading stale.
        BackgroundKind::Gradient => DQuat::IDENTITY,
    };
    let axis = |axis: DVec3| (world_from_map * axis).as_vec3().to_array();
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    Background {
        top: opaque(scene.background.top),
        bottom: opaque(scene.background.bottom),
        map_x: axis(DVec3::X),
        map_gain: 0.0,
        map_y: axis(DVec3::Y),
        map_z: axis(DVec3::Z),
        transparent_samples: 0.0,
    }
}

/// The environment map, if the scene shows the map and `at_hand` is that map.
pub fn shown<'a>(scene: &Scene, at_hand: Option<&'a EnvironmentMap>) -> Option<&'a EnvironmentMap> {
    let name = &scene.lights.rig.environment_map.name;
    let is_wanted =
        scene.background.kind == BackgroundKind::EnvironmentMap && scene.lights.rig.intensity > 0.0;
    at_hand.filter(|environment_map| is_wanted && environment_map.name() == name)
}

/// The rotation from the rig's frame into world space.
pub fn world_from_rig(scene: &Scene) -> DQuat {
    match scene.lights.rig.frame {
        LightFrame::Scene => DQuat::IDENTITY,
        LightFrame::View => scene.camera.rotation(),
    }
}

/// The rotation from the environment map's own frame into world space.
pub fn world_from_map(scene: &Scene) -> DQuat {
    let rotation_deg = scene.lights.rig.environment_map.rotation_deg;
    world_from_rig(scene) * DQuat::from_rotation_z(rotation_deg.to_radians())
}
