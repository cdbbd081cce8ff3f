//! A scene's lights as the shaders see them, and which of them shine.

use bytemuck::Zeroable;
use glam::{DVec3, Vec3};

use super::Light;
use crate::scene::{LightFrame, MAX_LIGHTS, Scene};

/// The scene's lights: environment, then point lights, then the rig's, each with the visibility bit
/// of its place. Muted ones stay, in black.
pub fn lights(scene: &Scene) -> [Light; MAX_LIGHTS] {
    let any_solo = scene.lights.any_solo();
    let color = |[r, g, b]: [f32; 3], intensity: f64, muted: bool, solo: bool| {
        let shines = !muted && (solo || !any_solo);
        let strength = if shines { intensity as f32 } else { 0.0 };
        [r * strength, g * strength, b * strength]
    };
    let casts = |wanted: bool| u32::from(wanted && scene.quality.shadows);
    let view_unit = scene.camera.view_unit();
    let in_world = |frame: LightFrame, direction: DVec3| {
        let direction = match frame {
            LightFrame::Scene => direction,
            LightFrame::View => scene.camera.rotation() * direction,
        };
        direction.as_vec3().normalize_or(Vec3::Z).to_array()
    };
    let environment = scene.lights.environment.iter().map(|light| {
        let direction = DVec3::from_array(light.direction);
        let radiance = color(light.color, light.intensity, light.muted, light.solo);
        Light {
            vector: in_world(light.frame, direction),
            kind: 0,
            color: radiance,
            casts_shadows: casts(light.casts_shadows),
            shadow_reach: light.shadow_reach.map_or(1e30, |reach| (reach * view_unit) as f32),
            ..Light::zeroed()
        }
    });
    let point = scene.lights.point.iter().map(|light| {
        let radiance = color(light.color, light.intensity, light.muted, light.solo);
        Light {
            vector: light.position.to_dvec3().as_vec3().to_array(),
            kind: 1,
            color: radiance,
            casts_shadows: casts(light.casts_shadows),
            shadow_reach: 1e30,
            ..Light::zeroed()
        }
    });
    let rig = &scene.lights.rig;
    let rig_lights = rig.lights().into_iter().map(|(direction, strength)| {
        let radiance = color(strength.as_vec3().to_array(), 1.0, rig.muted, rig.solo);
        Light {
            vector: in_world(rig.frame, direction),
            kind: 0,
            color: radiance,
            casts_shadows: casts(rig.casts_shadows),
            shadow_reach: rig.shadow_reach.map_or(1e30, |reach| (reach * view_unit) as f32),
            ..Light::zeroed()
        }
    });
    let mut table = [Light::zeroed(); MAX_LIGHTS];
    let all = environment.chain(point).chain(rig_lights);
    for (bit, (slot, light)) in (0..).zip(table.iter_mut().zip(all)) {
        *slot = Light { bit, ..light };
    }
    table
}

/// The visibility bits of the lights that shine: only they need any.
pub fn shining(lights: &[Light]) -> u64 {
    let shine = lights.iter().filter(|light| light.color != [0.0; 3]);
    shine.fold(0, |bits, light| bits | 1 << light.bit)
}
