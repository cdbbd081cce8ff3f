//! The opening scenes, and the dives.
//!
//! In: nothing. Out: scenes to start from, each valid, the eye outside of the set and
//! the pivot on or near what it shows; and places at depth.

mod dives;
mod preset;

use glam::DVec3;

use super::{
    background::Background,
    camera::Camera,
    description::Scene,
    indirect::{Indirect, IndirectKind},
    light::{EnvironmentLight, LightFrame, PointLight},
    lighting::Lights,
    surface::{ColorSource, Coloring, GradientStop, Surface},
    tone::Tone,
};
use crate::formula::{self, Fractal, mandelbulb::Mandelbulb};

pub use dives::dives;
pub use preset::Preset;

/// Strength of new scenes' indirect light: crevices fill, and shapes keep their shadows.
const INDIRECT_STRENGTH: f64 = 0.35;

/// A fractal of the formula called `id`, with default values; a test checks the ids.
fn of_formula(id: &str) -> Fractal {
    Fractal::new(formula::find(id).unwrap_or_default())
}

/// The scene that the program opens on: the first of [`all`].
pub fn opening() -> Scene {
    new_scene(mandelbulb())
}

/// The opening scenes.
pub fn all() -> &'static [Preset] {
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

/// The opening scenes, and behind them the dives.
pub fn every() -> impl ExactSizeIterator<Item = &'static Preset> + Clone {
    let count = all().len();
    (0..count + dives().len()).map(move |i| if i < count { &all()[i] } else { &dives()[i - count] })
}

/// `scene` with what documents leave off and new scenes have.
///
/// Lights and gradient follow the view, and indirect light is on.
fn new_scene(scene: Scene) -> Scene {
    let coloring = Coloring { follows_view: true, ..scene.surface.coloring };
    Scene {
        surface: Surface { coloring, ..scene.surface },
        lights: Lights { follow_view: true, ..scene.lights },
        indirect: Indirect {
            kind: IndirectKind::Horizon,
            strength: INDIRECT_STRENGTH,
            ..scene.indirect
        },
        ..scene
    }
}

/// The camera at `eye`, looking at `pivot`, the world's z upward.
fn camera(eye: [f64; 3], pivot: [f64; 3], vertical_fov_deg: f64) -> Camera {
    let (eye, pivot) = (DVec3::from_array(eye), DVec3::from_array(pivot));
    Camera { vertical_fov_deg, ..Camera::looking_at(eye, pivot, DVec3::Z) }
}

/// A light from `direction`, of any length.
fn light(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    let direction = DVec3::from_array(direction).normalize_or(DVec3::Z).to_array();
    EnvironmentLight { direction, color, intensity, ..Default::default() }
}

/// A light that stays with the camera, from `direction` in its frame.
fn headlight(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    EnvironmentLight { frame: LightFrame::View, ..light(direction, color, intensity) }
}

fn stops(list: &[(f64, [f32; 3])]) -> Vec<GradientStop> {
    list.iter().map(|&(position, color)| GradientStop { position, color }).collect()
}

/// The opening picture: a warm key from the left, a cool rim behind, dark ground.
fn mandelbulb() -> Scene {
    Scene {
        camera: camera([0.95, -2.05, 1.05], [0.08, 0.0, 0.06], 41.0),
        lights: Lights {
            environment: vec![
                light([-0.75, -0.55, 0.62], [1.0, 0.8, 0.56], 2.4),
                light([0.8, 0.6, 0.25], [0.4, 0.62, 1.0], 2.0),
                EnvironmentLight {
                    casts_shadows: false,
                    ..headlight([0.5, 0.35, 0.8], [0.5, 0.66, 1.0], 0.4)
                },
            ],
            point: vec![],
            ..Default::default()
        },
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
                source: ColorSource::OriginTrap,
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

fn four_petals() -> Scene {
    Scene {
        fractal: Mandelbulb { power: 4.0, iterations: 14, ..Default::default() }.into(),
        camera: camera([1.55, -2.4, 1.35], [0.0, 0.0, 0.0], 40.0),
        lights: Lights {
            environment: vec![
                light([-0.4, -0.8, 0.7], [1.0, 0.9, 0.95], 2.4),
                light([0.9, 0.1, 0.1], [0.9, 0.35, 0.6], 0.9),
                light([-0.2, 0.9, 0.4], [0.5, 0.6, 1.0], 1.3),
            ],
            point: vec![],
            ..Default::default()
        },
        surface: Surface {
            gradient: stops(&[
                (0.0, [0.07, 0.01, 0.10]),
                (0.25, [0.48, 0.07, 0.30]),
                (0.5, [0.88, 0.36, 0.46]),
                (0.7, [0.97, 0.78, 0.66]),
                (0.85, [0.40, 0.22, 0.50]),
            ]),
            ..Default::default()
        },
        background: Background::gradient([0.012, 0.006, 0.022], [0.07, 0.035, 0.08]),
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
                source: ColorSource::OriginTrap,
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
                source: ColorSource::OriginTrap,
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

fn lantern() -> Scene {
    let lamp = |position: [f64; 3], color, intensity| PointLight {
        position: DVec3::from_array(position).into(),
        color,
        intensity,
        ..Default::default()
    };
    Scene {
        camera: camera([0.35, -1.25, 0.25], [0.1, -0.85, 0.15], 55.0),
        lights: Lights {
            environment: vec![EnvironmentLight {
                casts_shadows: false,
                ..light([0.2, -0.4, 0.9], [0.35, 0.45, 0.8], 0.12)
            }],
            point: vec![
                lamp([0.2, -0.95, 0.2], [1.0, 0.62, 0.28], 0.06),
                lamp([0.0, -1.0, 0.35], [0.3, 0.55, 1.0], 0.04),
            ],
            ..Default::default()
        },
        surface: Surface { ambient: 0.02, ..Default::default() },
        tone: Tone { exposure: 0.3, ..Default::default() },
        background: Background::gradient([0.002, 0.002, 0.005], [0.01, 0.01, 0.016]),
        ..Default::default()
    }
}
