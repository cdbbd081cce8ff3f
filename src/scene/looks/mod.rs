//! Looks: appearances for any scene, whole or in part.
//!
//! In: a scene. Out: the same shape, camera, quality and path in other colours, light and tone.
//!
//! | file | contents |
//! |---|---|
//! | `complete` | looks of every part |
//! | `elements` | lights, materials and tones that those are made of |
//! | `parts` | colours, light setups, backgrounds and tones on their own |

mod complete;
mod elements;
mod parts;

use std::sync::LazyLock;

use super::{
    Background, Bloom, Camera, Fog, GradientStop, Lights, MediumKind, Scene, Surface, Tone,
    color::short_linear_from_srgb, presets::Preset,
};

/// An appearance: each part replaces that of a scene, and missing parts leave the scene's.
#[derive(Clone, Debug, Default)]
pub struct Look {
    /// The name in the panel, one of its own within its list.
    pub name: String,
    /// What it does to the picture.
    pub about: &'static str,
    /// The gradient of the surface's first layer.
    pub gradient: Option<Vec<GradientStop>>,
    /// The material and the second layer: all of the surface but [`Surface::coloring`], [`Surface::gradient`] and
    /// [`Surface::sections`], which stay.
    ///
    /// A material replaces a [`Medium`](super::Medium), which has no surface.
    pub material: Option<Surface>,
    /// The lights for a camera; the name and the lights of an environment map stay.
    pub lights: Option<fn(&Camera) -> Lights>,
    /// The background.
    pub background: Option<Background>,
    /// The fog.
    pub fog: Option<Fog>,
    /// Exposure and tone curve, and the bloom that belongs to them.
    pub tone: Option<(Tone, Bloom)>,
}

/// A list of looks.
#[derive(Debug)]
pub struct LookList {
    /// The heading in the panel.
    pub name: &'static str,
    /// What the list holds.
    pub about: &'static str,
    /// What one of the list is called before its name.
    pub kind: &'static str,
    /// The looks.
    pub looks: Vec<Look>,
}

impl LookList {
    /// The name of a look on the command line: `ember`, and `tone/film` in lists of parts.
    pub fn id(&self, look: &Look) -> String {
        let name = Preset::id_of(&look.name);
        if self.kind == complete::KIND {
            name
        } else {
            format!("{}/{name}", Preset::id_of(self.kind))
        }
    }
}

/// All lists: complete looks, then colours, light, backgrounds and tones.
pub fn lists() -> &'static [LookList] {
    static LISTS: LazyLock<Vec<LookList>> = LazyLock::new(|| {
        vec![
            complete::looks(),
            parts::colors(),
            parts::lights(),
            parts::backgrounds(),
            parts::tones(),
        ]
    });
    &LISTS
}

/// The look with this [id](LookList::id).
pub fn find(id: &str) -> Option<&'static Look> {
    let looks = lists().iter().flat_map(|list| list.looks.iter().map(move |look| (list, look)));
    looks.into_iter().find(|(list, look)| list.id(look) == id).map(|(_, look)| look)
}

/// Replaces the scene's parts that the look has.
pub fn apply(look: &Look, scene: &mut Scene) {
    if let Some(gradient) = &look.gradient {
        scene.surface.gradient.clone_from(gradient);
    }
    if let Some(material) = &look.material {
        let Surface { coloring, gradient, sections, .. } = std::mem::take(&mut scene.surface);
        scene.surface = Surface { coloring, gradient, sections, ..material.clone() };
        scene.medium.kind = MediumKind::None;
    }
    if let Some(lights) = look.lights {
        let environment_map = std::mem::take(&mut scene.lights.rig.environment_map);
        scene.lights = lights(&scene.camera);
        scene.lights.rig.environment_map = environment_map;
    }
    if let Some(background) = &look.background {
        scene.background.clone_from(background);
    }
    if let Some(fog) = &look.fog {
        scene.fog.clone_from(fog);
    }
    if let Some((tone, bloom)) = &look.tone {
        (scene.tone, scene.bloom) = (tone.clone(), bloom.clone());
    }
}

/// The scene with the look.
pub fn applied(look: &Look, scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    apply(look, &mut scene);
    scene
}

/// The linear colour of sRGB `0xRRGGBB`.
fn srgb(rgb: u32) -> [f32; 3] {
    let [_, rgb @ ..] = rgb.to_be_bytes();
    rgb.map(|channel| short_linear_from_srgb(f32::from(channel) / 255.0))
}

/// A stop with the sRGB colour `0xRRGGBB`.
fn stop(position: f64, rgb: u32) -> GradientStop {
    GradientStop { position, color: srgb(rgb) }
}

/// A gradient of sRGB colours, `0xRRGGBB`, at equal distances.
fn gradient(colors: &[u32]) -> Vec<GradientStop> {
    let count = colors.len() as f64;
    let position = |i: u32| (f64::from(i) / count * 1e4).round() / 1e4;
    (0..).zip(colors).map(|(i, &rgb)| stop(position(i), rgb)).collect()
}

/// A background from the sRGB colours `top` to `bottom`, `0xRRGGBB`.
fn background(top: u32, bottom: u32) -> Background {
    Background::gradient(srgb(top), srgb(bottom))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::scene::presets;

    fn all() -> impl Iterator<Item = (&'static LookList, &'static Look)> {
        lists().iter().flat_map(|list| list.looks.iter().map(move |look| (list, look)))
    }

    #[test]
    fn the_lists_are_long_enough_and_their_ids_differ() {
        for (list, least) in lists().iter().zip([12, 36, 4, 8, 6]) {
            assert!(list.looks.len() >= least, "{}: {}", list.name, list.looks.len());
        }
        let ids: Vec<String> = all().map(|(list, look)| list.id(look)).collect();
        let different: HashSet<_> = ids.iter().collect();
        assert_eq!(different.len(), ids.len(), "{ids:?}");
        for (id, (_, look)) in ids.iter().zip(all()) {
            assert_eq!(find(id).map(|found| &found.name), Some(&look.name));
        }
        assert!(find("nothing").is_none());
    }

    #[test]
    fn complete_looks_have_every_part_and_others_have_one() {
        for (list, look) in all() {
            let Look { gradient, material, lights, background, fog, tone, .. } = look;
            let parts = [
                gradient.is_some(),
                material.is_some(),
                lights.is_some(),
                background.is_some(),
                fog.is_some(),
                tone.is_some(),
            ];
            let count = parts.into_iter().filter(|part| *part).count();
            let wanted = if list.kind == complete::KIND { parts.len() } else { 1 };
            assert_eq!(count, wanted, "{} {}", list.kind, look.name);
        }
    }

    #[test]
    fn every_look_is_valid_in_every_scene_and_no_two_of_a_list_are_alike() {
        for preset in presets::all() {
            let scene = (preset.scene)();
            for list in lists() {
                let looks: Vec<Scene> =
                    list.looks.iter().map(|look| applied(look, &scene)).collect();
                for (i, (look, looked)) in list.looks.iter().zip(&looks).enumerate() {
                    assert_eq!(looked.validate(), Ok(()), "{} in {}", look.name, preset.name);
                    assert!(!looks[..i].contains(looked), "{} in {}", look.name, preset.name);
                }
            }
        }
    }

    #[test]
    fn an_environment_map_stays_at_hand_and_a_medium_gives_way() {
        let mut scene = Scene::default();
        scene.lights.rig.environment_map.name = "dusk.hdr".to_owned();
        scene.medium.kind = MediumKind::Set;
        let looked = applied(&lists()[0].looks[0], &scene);
        assert_eq!(looked.lights.rig.environment_map, scene.lights.rig.environment_map);
        assert_eq!(looked.medium.kind, MediumKind::None);
    }
}
