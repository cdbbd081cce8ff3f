//! The opening scenes, the dives, a scene for each formula, mixes of formulas, and scenes in path-traced light.
//!
//! In: nothing. Out: scenes to start from, each valid, the eye outside of the set and
//! the pivot on or near what it shows; and places at depth.

mod dives;
mod formulas;
mod mixes;
mod parts;
mod preset;
mod traced;

use super::{
    background::Background,
    description::Scene,
    lighting::Lights,
    surface::{ColorSource, Coloring, Surface},
};
use crate::formula::mandelbulb::Mandelbulb;

pub use dives::dives;
pub use formulas::formulas;
pub use mixes::mixes;
use parts::{
    camera, four_petals, headlight, key_and_rim, lantern, light, new_scene, of_formula, stops,
};
pub use preset::Preset;
pub use traced::traced;

/// The scene that the program opens on: the first of [`opening_scenes`].
pub fn opening() -> Scene {
    new_scene(mandelbulb())
}

/// The opening scenes.
pub fn opening_scenes() -> &'static [Preset] {
    &[
        Preset {
            name: "Mandelbulb",
            blurb: "Power 8: the set that gave the others their name.",
            scene: || new_scene(mandelbulb()),
        },
        Preset {
            name: "Coral reef",
            blurb: "Close to the power-8 bulb, where lobes grow on lobes.",
            scene: || new_scene(coral_reef()),
        },
        Preset {
            name: "Four petals",
            blurb: "Power 4: few lobes, deep folds.",
            scene: || new_scene(four_petals()),
        },
        Preset {
            name: "Sea urchin",
            blurb: "Power 16: a ball beset with small buds.",
            scene: || new_scene(sea_urchin()),
        },
        Preset {
            name: "In between",
            blurb: "Power 5.5: the seam where the turns do not close.",
            scene: || new_scene(in_between()),
        },
        Preset {
            name: "Julia",
            blurb: "One constant for every point: the bulb's Julia form.",
            scene: || new_scene(julia()),
        },
        Preset {
            name: "Whorls",
            blurb: "A quaternion Julia set: a shell of four dimensions, cut open.",
            scene: || new_scene(whorls()),
        },
        Preset {
            name: "Lantern",
            blurb: "A crevice of the power-8 bulb, lit from within by two points of light.",
            scene: || new_scene(lantern()),
        },
    ]
}

/// A list of scenes.
#[derive(Clone, Copy)]
pub struct PresetList {
    /// The heading of the list in the panel.
    pub name: &'static str,
    /// What the list holds.
    pub about: &'static str,
    /// The scenes.
    pub presets: &'static [Preset],
}

/// All lists, in order.
pub fn lists() -> [PresetList; 5] {
    let list = |name, about, presets| PresetList { name, about, presets };
    [
        list("Scenes", "Whole fractals and near views", opening_scenes()),
        list("Dives", "Views at very deep zooms", dives()),
        list("Formulas", "One view of each formula", formulas()),
        list("Mixes", "Hybrids of formulas, cuts, two layers of colours", mixes()),
        list("Light", "Scenes in path-traced light", traced()),
    ]
}

/// The scenes of all [`lists`], in order.
pub fn all() -> impl Iterator<Item = &'static Preset> + Clone {
    lists().into_iter().flat_map(|list| list.presets)
}

/// The opening picture: a warm key from the left, a cool rim behind, dark ground.
fn mandelbulb() -> Scene {
    Scene {
        camera: camera([1.32, -2.91, 1.45], [0.08, 0.0, 0.03], 41.0),
        lights: Lights { environment: key_and_rim(), point: vec![], ..Default::default() },
        surface: Surface {
            gradient: stops(&[
                (0.0, [0.015, 0.05, 0.085]),
                (0.22, [0.05, 0.20, 0.26]),
                (0.42, [0.46, 0.09, 0.05]),
                (0.67, [0.84, 0.42, 0.15]),
                (0.92, [0.80, 0.70, 0.53]),
            ]),
            ..Default::default()
        },
        background: Background::gradient([0.002, 0.003, 0.006], [0.010, 0.014, 0.022]),
        ..Default::default()
    }
}

fn coral_reef() -> Scene {
    Scene {
        camera: camera([0.62, -1.1, 0.62], [0.3, -0.62, 0.42], 45.0),
        lights: Lights {
            environment: vec![
                light([-0.5, -0.6, 0.9], [1.0, 0.84, 0.66], 2.6),
                light([0.9, -0.2, 0.2], [0.3, 0.6, 0.9], 0.9),
                headlight([0.0, 0.3, 1.0], [0.9, 0.95, 1.0], 0.25),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            coloring: Coloring {
                source: ColorSource::PointTrap,
                repeats: 1.4,
                offset: 0.1,
                ..Default::default()
            },
            gradient: stops(&[
                (0.0, [0.02, 0.08, 0.13]),
                (0.3, [0.75, 0.18, 0.14]),
                (0.5, [0.95, 0.52, 0.32]),
                (0.7, [0.90, 0.84, 0.68]),
                (0.85, [0.08, 0.34, 0.36]),
            ]),
            specular: 0.35,
            shininess: 60.0,
            ..Default::default()
        },
        background: Background::gradient([0.004, 0.02, 0.035], [0.01, 0.07, 0.09]),
        ..Default::default()
    }
}

fn sea_urchin() -> Scene {
    Scene {
        fractal: Mandelbulb { power: 16.0, iterations: 12, bailout: 3.0, ..Default::default() }
            .into(),
        camera: camera([1.3, -2.0, 1.05], [0.0, 0.0, 0.03], 44.0),
        lights: Lights {
            environment: vec![
                light([-0.7, -0.5, 0.7], [0.85, 0.9, 1.0], 2.4),
                light([0.9, -0.2, -0.1], [1.0, 0.5, 0.25], 1.0),
                light([0.1, 0.9, 0.5], [0.6, 0.4, 1.0], 1.6),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            coloring: Coloring {
                source: ColorSource::PointTrap,
                repeats: 1.0,
                offset: 0.0,
                ..Default::default()
            },
            gradient: stops(&[
                (0.0, [0.03, 0.02, 0.12]),
                (0.3, [0.16, 0.12, 0.50]),
                (0.5, [0.30, 0.45, 0.80]),
                (0.7, [0.85, 0.88, 0.95]),
                (0.9, [0.35, 0.20, 0.45]),
            ]),
            specular: 0.4,
            shininess: 90.0,
            ..Default::default()
        },
        background: Background::gradient([0.006, 0.006, 0.02], [0.03, 0.03, 0.07]),
        ..Default::default()
    }
}

fn in_between() -> Scene {
    Scene {
        fractal: Mandelbulb { power: 5.5, iterations: 14, ..Default::default() }.into(),
        camera: camera([-2.3, -1.7, 1.3], [0.0, 0.0, 0.0], 44.0),
        lights: Lights {
            environment: vec![
                light([-0.7, -0.2, 0.8], [1.0, 0.88, 0.6], 2.6),
                light([0.3, -0.9, 0.0], [0.5, 0.7, 1.0], 0.6),
                light([0.6, 0.7, 0.3], [1.0, 0.6, 0.35], 1.2),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            coloring: Coloring {
                source: ColorSource::AxisTrap,
                repeats: 1.2,
                offset: 0.05,
                ..Default::default()
            },
            gradient: stops(&[
                (0.0, [0.08, 0.04, 0.02]),
                (0.3, [0.50, 0.26, 0.05]),
                (0.55, [0.92, 0.66, 0.22]),
                (0.75, [0.98, 0.92, 0.72]),
                (0.88, [0.22, 0.28, 0.30]),
            ]),
            ..Default::default()
        },
        ..Default::default()
    }
}

fn whorls() -> Scene {
    Scene {
        fractal: of_formula("quaternion_julia"),
        camera: camera([2.1, -3.0, 2.0], [0.0, 0.0, 0.0], 38.0),
        lights: Lights {
            environment: vec![
                light([-0.6, -0.6, 0.8], [1.0, 0.93, 0.84], 2.5),
                light([0.9, -0.2, 0.1], [0.45, 0.62, 1.0], 0.8),
                light([0.2, 0.9, 0.3], [1.0, 0.72, 0.52], 1.1),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            coloring: Coloring {
                source: ColorSource::PointTrap,
                repeats: 1.1,
                offset: 0.12,
                ..Default::default()
            },
            gradient: stops(&[
                (0.0, [0.10, 0.05, 0.09]),
                (0.25, [0.52, 0.16, 0.20]),
                (0.5, [0.95, 0.62, 0.40]),
                (0.72, [0.98, 0.92, 0.80]),
                (0.88, [0.20, 0.36, 0.44]),
            ]),
            ..Default::default()
        },
        ..Default::default()
    }
}

fn julia() -> Scene {
    Scene {
        fractal: Mandelbulb { iterations: 14, julia: true, ..Default::default() }.into(),
        camera: camera([1.3, -2.2, 1.2], [0.0, 0.0, 0.0], 44.0),
        lights: Lights {
            environment: vec![
                light([-0.5, -0.7, 0.7], [1.0, 0.95, 0.88], 2.4),
                light([0.9, -0.3, 0.2], [0.25, 0.75, 0.9], 0.9),
                light([0.0, 0.9, 0.5], [0.9, 0.9, 1.0], 1.3),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            gradient: stops(&[
                (0.0, [0.01, 0.04, 0.09]),
                (0.3, [0.03, 0.28, 0.42]),
                (0.55, [0.25, 0.68, 0.70]),
                (0.75, [0.92, 0.90, 0.78]),
                (0.88, [0.55, 0.28, 0.12]),
            ]),
            specular: 0.35,
            shininess: 70.0,
            ..Default::default()
        },
        background: Background::gradient([0.004, 0.01, 0.018], [0.03, 0.055, 0.07]),
        ..Default::default()
    }
}
