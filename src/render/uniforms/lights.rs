//! The uniforms of a scene's lights, and their visibility bits.

use glam::{DVec3, Vec3};

use super::shared::Light;
use crate::{
    render::space::RenderSpace,
    scene::{LightFrame, MAX_LIGHTS, Scene, follow},
};

/// Distance in view units beyond which a point light is treated as a directional light.
///
/// Across the view its direction then changes by less than a pixel, and its strength by less than a
/// display resolves.
const FAR_VIEWS: f64 = 1e6;

/// The [effective](follow::effective) lights: environment lights, point lights, the rig's.
///
/// Each light's visibility bit is its index. Muted lights stay, in black.
pub fn lights(scene: &Scene, space: &RenderSpace) -> [Light; MAX_LIGHTS] {
    let shining = follow::effective(&scene.lights, &scene.camera);
    let any_solo = shining.any_solo();
    let color = |[r, g, b]: [f32; 3], intensity: f64, shines: bool| {
        let strength = if shines { intensity as f32 } else { 0.0 };
        [r * strength, g * strength, b * strength]
    };
    let casts = |wanted: bool| u32::from(wanted && scene.quality.shadows);
    let view_unit = scene.camera.view_unit() / space.scale();
    let in_world = |frame: LightFrame, direction: DVec3| {
        let direction = frame.to_world(direction, &scene.camera);
        direction.as_vec3().normalize_or(Vec3::Z).to_array()
    };
    let environment = shining.environment.iter().map(|light| {
        let direction = DVec3::from_array(light.direction);
        let radiance = color(light.color, light.intensity, light.shines(any_solo));
        Light {
            vector: in_world(light.frame, direction),
            kind: 0,
            color: radiance,
            casts_shadows: casts(light.casts_shadows),
            shadow_reach: light.shadow_reach.map_or(1e30, |reach| (reach * view_unit) as f32),
            size: (0.5 * light.size_deg).to_radians().sin() as f32,
            ..Light::default()
        }
    });
    let point = shining.point.iter().map(|light| {
        let place = space.point(&light.position);
        let way = place - space.point(&scene.camera.position);
        let casts_shadows = casts(light.casts_shadows);
        // In scene units the square of a distance may overflow an f32.
        let radius = light.radius / space.scale();
        let (vector, kind, falls, size) = if way.length() > FAR_VIEWS {
            let falls = way.length_squared().max(radius * radius);
            (way.normalize_or(DVec3::Z), 0, falls, (radius / way.length()).min(1.0))
        } else {
            (place, 1, 1.0, radius.min(1e15))
        };
        let strength = light.intensity / (space.scale() * space.scale()) / falls;
        Light {
            vector: vector.as_vec3().to_array(),
            kind,
            color: color(light.color, strength.min(1e30), light.shines(any_solo)),
            casts_shadows,
            shadow_reach: if kind == 0 {
                (way.length() - radius).clamp(0.0, 1e30) as f32
            } else {
                1e30
            },
            size: size as f32,
            ..Light::default()
        }
    });
    let rig = &shining.rig;
    let rig_lights = rig.lights().into_iter().map(|(direction, strength)| {
        let radiance = color(strength.as_vec3().to_array(), 1.0, rig.shines(any_solo));
        Light {
            vector: in_world(rig.frame, direction),
            kind: 0,
            color: radiance,
            casts_shadows: casts(rig.casts_shadows),
            shadow_reach: rig.shadow_reach.map_or(1e30, |reach| (reach * view_unit) as f32),
            ..Light::default()
        }
    });
    let mut table = [Light::default(); MAX_LIGHTS];
    let all = environment.chain(point).chain(rig_lights);
    for (bit, (slot, light)) in (0..).zip(table.iter_mut().zip(all)) {
        *slot = Light { bit, seed: bit, ..light };
    }
    table
}

/// The visibility bits of the lights that shine; other lights need none.
pub fn shining(lights: &[Light]) -> u64 {
    bits(lights.iter().filter(|light| light.color != [0.0; 3]))
}

/// Whether a light that shines has a size.
pub fn any_with_size(lights: &[Light]) -> bool {
    lights.iter().any(|light| light.size > 0.0 && light.color != [0.0; 3])
}

/// The visibility bits of the lights that surfaces block.
pub fn casting(lights: &[Light]) -> u64 {
    bits(lights.iter().filter(|light| light.casts_shadows != 0))
}

fn bits<'a>(lights: impl Iterator<Item = &'a Light>) -> u64 {
    lights.fold(0, |bits, light| bits | 1 << light.bit)
}

/// Gives lights the visibility bits of old lights with the same rays, else free bits.
///
/// So bits stay valid when lights are added, removed or reordered.
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
        // There are at least as many bits as lights.
        light.bit = taken.trailing_ones();
        taken |= 1 << light.bit;
    }
}

/// The visibility bits of the lights that no old light matches in bit and rays.
pub fn moved(lights: &[Light], old: &[Light]) -> u64 {
    let stayed = |light: &Light| {
        old.iter().any(|other| other.bit == light.bit && has_same_rays(light, other))
    };
    bits(lights.iter().filter(|light| !stayed(light)))
}

/// Whether rays toward both lights are the same, for any colour.
fn has_same_rays(a: &Light, b: &Light) -> bool {
    let rays = |light: &Light| Light { color: [0.0; 3], bit: 0, seed: 0, ..*light };
    rays(a) == rays(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(x: f32, bit: u32) -> Light {
        Light { vector: [x, 0.0, 1.0], color: [1.0; 3], bit, ..Light::default() }
    }

    /// Lights at these positions, with the bits of their indices.
    fn list(places: &[f32]) -> Vec<Light> {
        (0..).zip(places).map(|(bit, x)| light(*x, bit)).collect()
    }

    /// The bits of a new list, and which of them moved.
    fn follow(places: &[f32], old: &[Light]) -> (Vec<u32>, u64) {
        let mut new = list(places);
        keep_bits(&mut new, old);
        (new.iter().map(|light| light.bit).collect(), moved(&new, old))
    }

    #[test]
    fn lights_keep_their_bits() {
        let old = list(&[1.0, 2.0, 3.0]);
        assert_eq!(follow(&[1.0, 2.0, 3.0], &old), (vec![0, 1, 2], 0));
        // A light is moved, removed, added in front of the others, or two lights change places.
        assert_eq!(follow(&[1.0, 9.0, 3.0], &old), (vec![0, 1, 2], 0b010));
        assert_eq!(follow(&[2.0, 3.0], &old), (vec![1, 2], 0));
        assert_eq!(follow(&[9.0, 1.0, 2.0, 3.0], &old), (vec![3, 0, 1, 2], 0b1000));
        assert_eq!(follow(&[3.0, 2.0, 1.0], &old), (vec![2, 1, 0], 0));
        // A second light at the same position gets its own bit.
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
