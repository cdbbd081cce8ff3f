//! Scenes in path-traced light.

use glam::DVec3;

use super::{
    dives::dives,
    formulas::formulas,
    parts::{camera, four_petals, lantern, new_scene, stops},
    preset::Preset,
};
use crate::scene::{
    description::Scene,
    fog::Fog,
    integrator::{IntegratorKind, IntegratorSettings},
    light::{LightFrame, PointLight},
    lighting::Lights,
    medium::{Medium, MediumKind},
    quality::Quality,
    rig::{Rig, RigKind, Sky},
    surface::{ColorSource, Coloring, DrivenByLayer, SecondLayer, Surface, SurfaceModel},
};

/// The scenes in path-traced light.
pub fn traced() -> &'static [Preset] {
    &[
        Preset {
            name: "Skylight",
            blurb: "A crevice of the power-8 bulb under an open sky: light falls in and bounces between the walls.",
            scene: || new_scene(skylight()),
        },
        Preset {
            name: "Filigree",
            blurb: "Glowing threads in an Apollonian gasket, under a dim sky.",
            scene: || new_scene(filigree()),
        },
        Preset {
            name: "Lamp",
            blurb: "A Menger sponge around a glowing ball: warm walls inside, dusk outside.",
            scene: || new_scene(lamp()),
        },
        Preset {
            name: "Gold",
            blurb: "A bulb of power 4 in gold, which mirrors the sky, the sun and itself.",
            scene: || new_scene(gold()),
        },
        Preset {
            name: "Jade",
            blurb: "A translucent power-8 bulb: sunlight enters, scatters inside and comes out green.",
            scene: || new_scene(jade()),
        },
        Preset {
            name: "Beams",
            blurb: "A lamp in a Menger sponge, in fog: light falls out of its windows.",
            scene: || new_scene(beams()),
        },
        Preset {
            name: "Deep dahlia",
            blurb: "At 10⁻²⁰, power 16: petals about petals, in light that bounces between them.",
            scene: deep_dahlia,
        },
    ]
}

/// `scene` with light paths of this reach, in view units, and so many samples.
fn with_paths(scene: Scene, reach: Option<f64>, samples: u32) -> Scene {
    Scene {
        integrator: IntegratorSettings {
            kind: IntegratorKind::Path,
            reach,
            denoise: true,
            ..IntegratorSettings::default()
        },
        quality: Quality { samples, ..scene.quality },
        ..scene
    }
}

/// A sky alone as light.
fn sky(intensity: f64, sun_strength: f64) -> Lights {
    Lights {
        environment: Vec::new(),
        rig: Rig {
            kind: RigKind::Sky,
            intensity,
            shadow_reach: None,
            sky: Sky { sun_strength, ..Sky::default() },
            ..Rig::default()
        },
        ..Lights::default()
    }
}

/// The scene of a list's preset; a test checks the names.
fn named(list: &[Preset], name: &str) -> Scene {
    list.iter()
        .find(|preset| preset.name == name)
        .map(|preset| (preset.scene)())
        .unwrap_or_default()
}

fn skylight() -> Scene {
    with_paths(Scene { lights: sky(1.6, 0.0), ..lantern() }, None, 512)
}

/// The second layer is black but at small traps: there the surface glows.
fn filigree() -> Scene {
    let scene = named(formulas(), "Apollonian");
    let glow = SecondLayer {
        coloring: Coloring {
            source: ColorSource::PointTrap,
            follows_view: true,
            ..Coloring::default()
        },
        gradient: stops(&[
            (0.0, [1.0, 0.5, 0.15]),
            (0.08, [1.0, 0.35, 0.05]),
            (0.12, [0.0; 3]),
            (0.95, [0.0; 3]),
        ]),
        ..SecondLayer::default()
    };
    let surface = Surface {
        emission: 5.0,
        driven_by_layer: DrivenByLayer { emission: true, ..DrivenByLayer::default() },
        second_layer: glow,
        ..scene.surface
    };
    with_paths(Scene { lights: sky(0.25, 0.0), surface, ..scene }, Some(1.0), 512)
}

fn lamp() -> Scene {
    let scene = named(formulas(), "Menger sponge");
    let mut lights = sky(0.3, 0.0);
    lights.point.push(PointLight {
        position: DVec3::ZERO.into(),
        color: [1.0, 0.55, 0.2],
        intensity: 2.5,
        radius: 0.2,
        ..PointLight::default()
    });
    with_paths(Scene { lights, ..scene }, None, 512)
}

fn gold() -> Scene {
    let scene = four_petals();
    let surface = Surface {
        model: SurfaceModel::Physical,
        metalness: 1.0,
        roughness: 0.3,
        gradient: stops(&[(0.0, [1.0, 0.72, 0.29])]),
        ..scene.surface
    };
    let mut lights = sky(1.0, 1.2);
    lights.rig.sky.sun_size_deg = 30.0;
    let camera = camera([1.55, -2.15, 1.1], [0.0, 0.0, 0.05], 38.0);
    with_paths(Scene { lights, surface, camera, ..scene }, None, 512)
}

fn jade() -> Scene {
    let mut lights = sky(1.2, 5.0);
    lights.rig.sky.sun_size_deg = 6.0;
    lights.rig.sky.sun_direction = DVec3::new(0.9, 0.6, 0.3).normalize().to_array();
    let medium = Medium {
        kind: MediumKind::Set,
        color: [0.93, 0.99, 0.96],
        mean_free_path: 0.03,
        anisotropy: 0.2,
        ..Medium::default()
    };
    let mut scene = with_paths(Scene { lights, medium, ..lantern() }, None, 256);
    // Light goes a long way inside.
    scene.integrator.bounces = 16;
    scene
}

fn beams() -> Scene {
    let mut scene = lamp();
    scene.lights.rig.intensity = 0.04;
    for light in &mut scene.lights.point {
        (light.intensity, light.radius) = (30.0, 0.03);
    }
    scene.fog = Fog { density: 0.8, anisotropy: 0.0, radius: 1.0, ..Fog::default() };
    scene.fractal.iterations = 4;
    scene.camera = camera([2.6, -3.9, 2.3], [0.0; 3], 42.0);
    scene.quality.samples = 1024;
    scene
}

fn deep_dahlia() -> Scene {
    let scene = named(dives(), "Dahlia");
    let mut lights = sky(1.0, 2.0);
    lights.rig.frame = LightFrame::View;
    lights.rig.shadow_reach = Some(1.0);
    lights.rig.sky.sun_direction = DVec3::new(-0.5, 0.62, 0.6).normalize().to_array();
    // All around the eye is surface: without a limit no light comes in.
    with_paths(Scene { lights, ..scene }, Some(1.0), 256)
}
