//! Places that a light is turned to, as they look: each gets light.

use glam::DVec2;
use mandelight::{
    fractal::{FractalModel, camera_ray, pixel_cone, shine},
    render::{Pace, Region},
    scene::{Background, EnvironmentLight, Indirect, IndirectKind, Lights, Scene, Tone, presets},
};
use mandelight_test_support::view::{finished_in, rgb, sampled};

/// Width and height of the pictures, in pixels.
const SIZE_PX: [u32; 2] = [60, 40];

/// Least brightness of a lit place, of 255: a place in shadow has none.
const LEAST: u8 = 24;

/// A scene of white surfaces in the light of `lights` only.
fn bare(scene: &Scene, lights: Vec<EnvironmentLight>) -> Scene {
    let mut scene = Scene {
        lights: Lights { environment: lights, ..Lights::default() },
        background: Background::gradient([0.0; 3], [0.0; 3]),
        tone: Tone::default(),
        indirect: Indirect { kind: IndirectKind::Off, ..Indirect::default() },
        ..scene.clone()
    };
    scene.lights.point.clear();
    scene.lights.follow_view = false;
    scene.surface.ambient = 0.0;
    for stop in &mut scene.surface.gradient {
        stop.color = [1.0; 3];
    }
    scene
}

/// The brightness of each pixel.
fn greys(scene: &Scene) -> Vec<u8> {
    let view = finished_in(&sampled(scene.clone(), 1), Region::whole(SIZE_PX), Pace::Still);
    rgb(&view).into_iter().map(|pixel| pixel[1]).collect()
}

#[test]
fn the_place_under_the_pointer_gets_light() {
    let [width, height] = SIZE_PX;
    let aspect = f64::from(width) / f64::from(height);
    let (mut lit, mut was_dark) = (0, 0);
    for index in [0, 1, 4] {
        let scene = (presets::opening_scenes()[index].scene)();
        let camera = &scene.camera;
        let model = FractalModel::new(&scene.fractal);
        let field = &**model.whole();
        let cone = pixel_cone(camera, aspect, f64::from(height));
        // In light from below and behind, most places are in shadow.
        let behind = camera.rotation() * glam::DVec3::new(0.2, -0.7, -0.7);
        let mut dark = EnvironmentLight::new(behind.to_array(), [1.0; 3], 1.0);
        dark.shadow_reach = None;
        let before = greys(&bare(&scene, vec![dark.clone()]));
        for pixel in [[20, 14], [30, 20], [38, 26], [26, 27], [34, 12]] {
            let [x, y] = pixel.map(f64::from);
            let part = |at: f64, side: u32| 2.0 * (at + 0.5) / f64::from(side) - 1.0;
            let ndc = DVec2::new(part(x, width), -part(y, height));
            let ray = camera_ray(camera, &field.origin(), ndc, aspect);
            let Some(depth) = field.march(ray, cone, f64::INFINITY) else { continue };
            let place = shine::Place {
                point: ray.at(depth),
                footprint: cone * depth,
                toward_eye: -ray.direction,
            };
            let toward = shine::toward_light(field, &place, camera.rotation() * glam::DVec3::Y);
            let mut light = dark.clone();
            light.direction = toward.to_array();
            let after = greys(&bare(&scene, vec![light]));
            let at = (pixel[1] * width + pixel[0]) as usize;
            assert!(after[at] >= LEAST, "scene {index}, {pixel:?}: {} of 255", after[at]);
            lit += 1;
            was_dark += u32::from(before[at] < LEAST);
        }
    }
    assert!(lit >= 12 && was_dark >= 8, "{lit} places, of which {was_dark} were dark");
}
