//! The check of a scene that was read: directions of length 1, then validation.

use glam::{DQuat, DVec3};

use super::error::DocumentError;
use crate::scene::{description::Scene, validate::UNIT_TOLERANCE};

/// How far from 1 the length of a direction may be in a document: written by hand with three
/// digits it is still meant to be a direction.
const UNIT_TOLERANCE_READ: f64 = 1e-3;

/// The scene, valid, its directions of length 1.
pub fn checked(scene: Scene) -> Result<Scene, DocumentError> {
    let scene = normalized(scene);
    scene.validate()?;
    Ok(scene)
}

/// The scene with its directions and orientation brought to length 1 where they nearly have it.
pub fn normalized(mut scene: Scene) -> Scene {
    let directions = scene.lights.environment.iter_mut().map(|light| &mut light.direction);
    let planes = scene.fractal.section_planes.iter_mut().map(|plane| &mut plane.direction);
    for direction in directions.chain([&mut scene.lights.rig.sky.sun_direction]).chain(planes) {
        let vector = DVec3::from_array(*direction);
        if is_nearly_unit(vector.length()) {
            *direction = vector.normalize().to_array();
        }
    }
    let orientation = DQuat::from_array(scene.camera.orientation.0);
    if is_nearly_unit(orientation.length()) {
        scene.camera.orientation = orientation.normalize().into();
    }
    scene
}

/// True where normalizing is called for and harmless: what is already right keeps its bits.
fn is_nearly_unit(length: f64) -> bool {
    (UNIT_TOLERANCE..=UNIT_TOLERANCE_READ).contains(&(length - 1.0).abs())
}
