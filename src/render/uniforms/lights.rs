//! A scene's lights as the shaders see them, and which of them shine.

use bytemuck::Zeroable;
use glam::{DVec3, Vec3};

use super::Light;
use crate::{
    render::space::RenderSpace,
    scene::{LightFrame, MAX_LIGHTS, Scene},
};

/// So many views away a point light is as good as one from its direction: across the view its own
/// changes by less than a pixel, and its strength by less than a display shows.
const FAR_VIEWS: f64 = 1e6;

/// The scene's lights: environment, then point lights, then the rig's, each with the visibility bit
/// of its place. Muted ones stay, in black.
pub fn lights(scene: &Scene, space: &RenderSpace) -> [Light; MAX_LIGHTS] {
    let any_solo = scene.lights.any_solo();
    let color = |[r, g, b]: [f32; 3], intensity: f64, muted: bool, solo: bool| {
        let shines = !muted && (solo || !any_solo);
        let strength = if shines { intensity as f32 } else { 0.0 };
        [r * strength, g * strength, b * strength]
    };
    let casts = |wanted: bool| u32::from(wanted && scene.quality.shadows);
    let view_unit = scene.camera.view_unit() / space.scale();
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
        let place = space.point(&light.position);
        let way = place - space.point(&scene.camera.position);
        let casts_shadows = casts(light.casts_shadows);
        // In scene units the square of a distance may be past what an f32 holds.
        let (vector, kind, falls) = if way.length() > FAR_VIEWS {
            (way.normalize_or(DVec3::Z), 0, way.length_squared())
        } else {
            (place, 1, 1.0)
        };
        let strength = light.intensity / (space.scale() * space.scale()) / falls;
        Light {
            vector: vector.as_vec3().to_array(),
            kind,
            color: color(light.color, strength.min(1e30), light.muted, light.solo),
            casts_shadows,
            shadow_reach: if kind == 0 { way.length().min(1e30) as f32 } else { 1e30 },
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
    bits(lights.iter().filter(|light| light.color != [0.0; 3]))
}

/// The visibility bits of the lights that surfaces block.
pub fn casting(lights: &[Light]) -> u64 {
    bits(lights.iter().filter(|light| light.casts_shadows != 0))
}

fn bits<'a>(lights: impl Iterator<Item = &'a Light>) -> u64 {
    lights.fold(0, |bits, light| bits | 1 << light.bit)
}

/// Gives each light the visibility bit of an old one whose rays are its own, as far as there are
/// such; the others get bits that are free. So no bit is lost where lights come, go or change places.
pub fn keep_bits(lights: &mut [Light], old: &[Light]) {
    let mut taken = 0_u64;
    let mut strangers = Vec::new();
    for light in lights {
        let same = |other: &&Light| taken >> other.bit & 1 == 0 && has_same_rays(light, other);
        match old.iter().find(same) {
            Some(other) => {
                light.bit = other.bit;
                taken |= 1 << light.bit;
            }
            None => strangers.push(light),
        }
    }
    for light in strangers {
        // There are as many bits as lights at most.
        light.bit = taken.trailing_ones();
        taken |= 1 << light.bit;
    }
}

/// The visibility bits of the lights whose rays no old light with the same bit had.
pub fn moved(lights: &[Light], old: &[Light]) -> u64 {
    let stayed = |light: &Light| {
        old.iter().any(|other| other.bit == light.bit && has_same_rays(light, other))
    };
    bits(lights.iter().filter(|light| !stayed(light)))
}

/// Whether rays toward both lights are the same: colour has no part in it.
fn has_same_rays(a: &Light, b: &Light) -> bool {
    let rays = |light: &Light| Light { color: [0.0; 3], bit: 0, ..*light };
    rays(a) == rays(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(x: f32, bit: u32) -> Light {
        Light { vector: [x, 0.0, 1.0], color: [1.0; 3], bit, ..Light::zeroed() }
    }

    /// Lights at these places with the bits of their places in the list.
    fn list(places: &[f32]) -> Vec<Light> {
        (0..).zip(places).map(|(bit, x)| light(*x, bit)).collect()
    }

    /// The bits that a new list gets, and which of them moved.
    fn follow(places: &[f32], old: &[Light]) -> (Vec<u32>, u64) {
        let mut new = list(places);
        keep_bits(&mut new, old);
        (new.iter().map(|light| light.bit).collect(), moved(&new, old))
    }

    #[test]
    fn lights_keep_their_bits() {
        let old = list(&[1.0, 2.0, 3.0]);
        assert_eq!(follow(&[1.0, 2.0, 3.0], &old), (vec![0, 1, 2], 0));
        // One is moved, removed, added in front of the others, or two change places.
        assert_eq!(follow(&[1.0, 9.0, 3.0], &old), (vec![0, 1, 2], 0b010));
        assert_eq!(follow(&[2.0, 3.0], &old), (vec![1, 2], 0));
        assert_eq!(follow(&[9.0, 1.0, 2.0, 3.0], &old), (vec![3, 0, 1, 2], 0b1000));
        assert_eq!(follow(&[3.0, 2.0, 1.0], &old), (vec![2, 1, 0], 0));
        // A second one at the same place has a bit of its own.
        assert_eq!(follow(&[2.0, 2.0], &old), (vec![1, 0], 0b01));
        assert_eq!(follow(&[], &old), (vec![], 0));
    }

    #[test]
    fn a_full_table_has_room_for_every_change() {
        let places: Vec<f32> = (0..MAX_LIGHTS as u16).map(f32::from).collect();
        let mut old = list(&places);
        let mut random = 1_u32;
        for _ in 0..200 {
            let mut new = old.clone();
            for light in &mut new {
                random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                if random >> 30 == 0 {
                    light.vector[1] += 1.0;
                }
            }
            let by = (random >> 20) as usize % MAX_LIGHTS;
            new.rotate_left(by);
            keep_bits(&mut new, &old);
            assert_eq!(new.iter().fold(0, |bits, light| bits | 1 << light.bit), u64::MAX);
            for light in &new {
                let other = old.iter().find(|other| other.vector == light.vector);
                assert!(other.is_none_or(|other| other.bit == light.bit));
            }
            old = new;
        }
    }

    #[test]
    fn colour_is_no_move() {
        let old = list(&[1.0]);
        let mut new = old.clone();
        new[0].color = [0.0; 3];
        assert_eq!(moved(&new, &old), 0);
        assert_eq!((shining(&old), shining(&new)), (1, 0));
        for change in [
            |light: &mut Light| light.casts_shadows = 1,
            |light: &mut Light| light.shadow_reach = 2.0,
            |light: &mut Light| light.kind = 1,
        ] {
            let mut new = old.clone();
            change(&mut new[0]);
            assert_eq!(moved(&new, &old), 1);
        }
    }
}
