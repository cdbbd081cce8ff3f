//! What several presets are made of.

use glam::DVec3;

use crate::{
    formula::{self, Fractal, mandelbulb::Mandelbulb},
    scene::{
        background::Background,
        camera::Camera,
        description::Scene,
        gradient::library,
        indirect::{Indirect, IndirectKind},
        light::{EnvironmentLight, PointLight},
        lighting::Lights,
        surface::{Coloring, GradientStop, Surface},
        tone::Tone,
    },
};

/// Strength of new scenes' indirect light: crevices fill, and shapes keep their shadows.
const INDIRECT_STRENGTH: f64 = 0.35;

/// A fractal of the formula called `id`, with default values; a test checks the ids.
pub(super) fn of_formula(id: &str) -> Fractal {
    Fractal::new(formula::find(id).unwrap_or_default())
}

/// `scene` with what documents leave off and new scenes have.
///
/// Lights and gradient follow the view, and indirect light is on.
pub(super) fn new_scene(scene: Scene) -> Scene {
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

/// `fractal` in the light of [`key_and_rim`], on a dark background.
pub(super) fn lit(fractal: Fractal, camera: Camera, surface: Surface) -> Scene {
    Scene {
        fractal,
        camera,
        lights: Lights { environment: key_and_rim(), ..Lights::default() },
        surface,
        background: Background::gradient([0.004, 0.006, 0.012], [0.02, 0.028, 0.045]),
        ..Scene::default()
    }
}

/// The camera at `eye`, looking at `pivot`, the world's z upward.
pub(super) fn camera(eye: [f64; 3], pivot: [f64; 3], vertical_fov_deg: f64) -> Camera {
    let (eye, pivot) = (DVec3::from_array(eye), DVec3::from_array(pivot));
    Camera { vertical_fov_deg, ..Camera::looking_at(eye, pivot, DVec3::Z) }
}

/// A light from `direction`, of any length.
pub(super) fn light(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    EnvironmentLight::new(direction, color, intensity)
}

/// A light that stays with the camera, from `direction` in its frame.
pub(super) fn headlight(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    EnvironmentLight::headlight(direction, color, intensity)
}

/// The stops of the program's gradient called `name`; a test checks the names.
pub(super) fn gradient(name: &str) -> Vec<GradientStop> {
    library()
        .find(|gradient| gradient.name == name)
        .map(|gradient| gradient.stops)
        .unwrap_or_default()
}

/// A gradient of positions and linear colours.
pub(super) fn stops(list: &[(f64, [f32; 3])]) -> Vec<GradientStop> {
    list.iter().map(|&(position, color)| GradientStop { position, color }).collect()
}

/// A warm key from the left, a cool rim behind, and a weak light that stays with the camera.
pub(super) fn key_and_rim() -> Vec<EnvironmentLight> {
    vec![
        light([-0.75, -0.55, 0.62], [1.0, 0.8, 0.56], 2.4),
        light([0.8, 0.6, 0.25], [0.4, 0.62, 1.0], 2.0),
        EnvironmentLight {
            casts_shadows: false,
            ..headlight([0.5, 0.35, 0.8], [0.5, 0.66, 1.0], 0.4)
        },
    ]
}

/// Power 4, in rose.
pub(super) fn four_petals() -> Scene {
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

/// A crevice of the power-8 bulb with two points of light.
pub(super) fn lantern() -> Scene {
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
