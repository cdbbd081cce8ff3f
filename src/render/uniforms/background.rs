//! The uniforms of the background.

use glam::{DQuat, DVec3};

use super::Background;
use crate::scene::{BackgroundKind, EnvironmentMap, LightFrame, Scene};

/// The scene's background: the gradient, until [`shown`] finds the environment map.
pub fn background(scene: &Scene) -> Background {
    let rig = &scene.lights.rig;
    let frame = match rig.frame {
        LightFrame::Scene => DQuat::IDENTITY,
        LightFrame::View => scene.camera.rotation(),
    };
    let world_from_map = match scene.background.kind {
        BackgroundKind::EnvironmentMap => {
            frame * DQuat::from_rotation_z(rig.environment_map.rotation_deg.to_radians())
        }
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
    }
}

/// The environment map, if the scene shows the map and `at_hand` is that map.
pub fn shown<'a>(scene: &Scene, at_hand: Option<&'a EnvironmentMap>) -> Option<&'a EnvironmentMap> {
    let name = &scene.lights.rig.environment_map.name;
    let is_wanted =
        scene.background.kind == BackgroundKind::EnvironmentMap && scene.lights.rig.intensity > 0.0;
    at_hand.filter(|environment_map| is_wanted && environment_map.name() == name)
}
