//! Starting points of light: setups that photographers know, for any view.
//!
//! In: the camera. Out: lights that stay with it, or stand near what it looks at.

use glam::DVec3;

use super::{
    Camera, EnvironmentLight, LightFrame, Lights, PointLight, Rig, RigKind, param, rig::Sky,
};

/// A setup of lights.
#[derive(Clone, Copy)]
pub struct LightSetup {
    /// The name in the panel.
    pub name: &'static str,
    /// What it does to the picture.
    pub about: &'static str,
    /// The lights for a camera.
    pub lights: fn(&Camera) -> Lights,
}

/// All setups.
pub const SETUPS: [LightSetup; 4] = [
    LightSetup {
        name: "Studio",
        about: "Three lights that stay with you: a warm key, a soft fill, a rim from behind",
        lights: studio,
    },
    LightSetup {
        name: "Rim",
        about: "Two lights from behind, warm and cool, draw the edges",
        lights: rim,
    },
    LightSetup {
        name: "Sky",
        about: "The light of an open sky with a sun, which turns with you",
        lights: sky,
    },
    LightSetup {
        name: "Candle",
        about: "One warm lamp near the middle of the view, and a little blue light",
        lights: candle,
    },
];

fn of(environment: Vec<EnvironmentLight>) -> Lights {
    Lights { environment, ..Lights::default() }
}

fn studio(_: &Camera) -> Lights {
    let fill = EnvironmentLight {
        casts_shadows: false,
        ..EnvironmentLight::headlight([0.7, 0.15, 0.7], [0.72, 0.82, 1.0], 0.55)
    };
    of(vec![
        EnvironmentLight::headlight([-0.6, 0.55, 0.65], [1.0, 0.9, 0.78], 2.4),
        fill,
        EnvironmentLight::headlight([0.6, 0.45, -0.65], [0.85, 0.92, 1.0], 2.0),
    ])
}

fn rim(_: &Camera) -> Lights {
    let front = EnvironmentLight {
        casts_shadows: false,
        ..EnvironmentLight::headlight([0.0, 0.3, 1.0], [0.7, 0.78, 1.0], 0.3)
    };
    of(vec![
        EnvironmentLight::headlight([-0.85, 0.35, -0.35], [1.0, 0.72, 0.45], 3.2),
        EnvironmentLight::headlight([0.85, 0.25, -0.35], [0.45, 0.66, 1.0], 3.2),
        front,
    ])
}

fn sky(_: &Camera) -> Lights {
    let sky =
        Sky { sun_direction: DVec3::new(-0.5, 0.6, 0.65).normalize().to_array(), ..Sky::default() };
    let rig = Rig { kind: RigKind::Sky, frame: LightFrame::View, sky, ..Rig::default() };
    Lights { rig, ..of(Vec::new()) }
}

fn candle(camera: &Camera) -> Lights {
    let unit = camera.view_unit();
    // Inside a square picture's left edge, at any field of view.
    let edge = camera.half_height(1.0);
    let offset = DVec3::new(-0.9 * edge, -0.42 * edge, -1.0) * (0.52 * unit);
    let position = camera.position.moved_by(camera.rotation() * offset, 1e-4 * unit);
    let distance = (&position - &camera.pivot).length();
    let lamp = PointLight {
        position,
        color: [1.0, 0.62, 0.3],
        intensity: param::POINT_INTENSITY.clamp(2.2 * distance * distance),
        ..PointLight::default()
    };
    let dim = EnvironmentLight {
        casts_shadows: false,
        ..EnvironmentLight::headlight([0.3, 0.6, 0.7], [0.4, 0.55, 1.0], 0.35)
    };
    Lights { point: vec![lamp], ..of(vec![dim]) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, presets};

    #[test]
    fn the_candle_is_in_the_picture() {
        for preset in presets::all() {
            let camera = (preset.scene)().camera;
            let lamp = &candle(&camera).point[0];
            let seen = camera.rotation().inverse() * (&lamp.position - &camera.position);
            let edge = camera.half_height(1.0) * -seen.z;
            assert!(seen.z < 0.0 && seen.x.abs().max(seen.y.abs()) < edge, "{}", preset.name);
        }
    }

    #[test]
    fn every_setup_is_valid_in_every_view() {
        for preset in presets::all() {
            let scene = (preset.scene)();
            for setup in SETUPS {
                let lights = (setup.lights)(&scene.camera);
                assert!(!lights.is_empty(), "{}", setup.name);
                let lit = Scene { lights, ..scene.clone() };
                assert_eq!(lit.validate(), Ok(()), "{} in {}", setup.name, preset.name);
            }
        }
    }
}
