//! What lies behind the fractal, as the shaders see it.

use glam::{DQuat, DVec3};

use super::Background;
use crate::scene::{BackgroundKind, EnvironmentMap, LightFrame, Scene};

/// The scene's background: the gradient until [`shown`] says that the picture is at hand.
pub fn background(scene: &Scene) -> Background {
    let rig = &scene.lights.rig;
    let frame = match rig.frame {
        LightFrame::Scene => DQuat::IDENTITY,
        LightFrame::View => scene.camera.rotation(),
    };
    let world_from_picture = match scene.background.kind {
        BackgroundKind::Picture => {
            frame * DQuat::from_rotation_z(rig.picture.rotation_deg.to_radians())
        }
        // How a picture that is not shown would lie is no reason to shade again.
        BackgroundKind::Gradient => DQuat::IDENTITY,
    };
    let axis = |axis: DVec3| (world_from_picture * axis).as_vec3().to_array();
    let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
    Background {
        top: opaque(scene.background.top),
        bottom: opaque(scene.background.bottom),
        picture_x: axis(DVec3::X),
        picture_gain: 0.0,
        picture_y: axis(DVec3::Y),
        unused_a: 0,
        picture_z: axis(DVec3::Z),
        unused_b: 0,
    }
}

/// The environment map, where the scene shows it and `at_hand` is the one that it
/// names.
pub fn shown<'a>(scene: &Scene, at_hand: Option<&'a EnvironmentMap>) -> Option<&'a EnvironmentMap> {
    let name = &scene.lights.rig.picture.name;
    let is_wanted =
        scene.background.kind == BackgroundKind::Picture && scene.lights.rig.intensity > 0.0;
    at_hand.filter(|environment_map| is_wanted && environment_map.name() == name)
}
