//! What several presets are made of.

use glam::DVec3;

use crate::{
    formula::{self, Fractal},
    scene::{
        background::Background,
        camera::Camera,
        description::Scene,
        gradient::library,
        indirect::{Indirect, IndirectKind},
        light::{EnvironmentLight, LightFrame},
        lighting::Lights,
        surface::{Coloring, GradientStop, Surface},
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
    let direction = DVec3::from_array(direction).normalize_or(DVec3::Z).to_array();
    EnvironmentLight { direction, color, intensity, ..Default::default() }
}

/// A light that stays with the camera, from `direction` in its frame.
pub(super) fn headlight(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    EnvironmentLight { frame: LightFrame::View, ..light(direction, color, intensity) }
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
