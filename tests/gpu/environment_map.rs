//! Light and background from all around: a rig's lights are those of a list, and what is seen
//! past the fractal is the picture, held to an f64 look at its pixels.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use mandelight::{
    render::{Pace, Region, View, pass::march, recorder::Count},
    scene::{
        BackgroundKind, Camera, EnvironmentLight, EnvironmentMap, LightFrame, Rig, RigKind, Scene,
        environment_map::uv_from_direction,
    },
};
use mandelight_test_support::view::{finished, pipelines, pixels, sampled, settle, still};

const SIZE: [u32; 2] = [64, 48];

/// A picture in which every direction has a colour of its own.
fn colourful(size_px: [u32; 2]) -> Arc<EnvironmentMap> {
    Arc::new(EnvironmentMap::from_fn("colourful.hdr", size_px, |to| {
        let wave = (to.x * 7.0).sin() * (to.y * 5.0).cos() * (to.z * 6.0).sin();
        DVec3::new(1.0 + to.x, 3.0 + 3.0 * wave, 0.2 + to.z * to.z)
    }))
}

/// Nothing but background: a camera far from the set that looks away from it.
fn away(toward: DVec3) -> Scene {
    let eye = toward.normalize() * 20.0;
    let up = if toward.z.abs() > 0.9 * toward.length() { DVec3::X } else { DVec3::Z };
    let mut scene = sampled(Scene::default(), 1);
    scene.camera = Camera { vertical_fov_deg: 70.0, ..Camera::looking_at(eye, eye * 1.1, up) };
    scene.background.kind = BackgroundKind::EnvironmentMap;
    scene.lights.rig.environment_map.name = "colourful.hdr".into();
    scene
}

fn film(scene: &Scene, environment_map: Option<&Arc<EnvironmentMap>>) -> Vec<[f32; 3]> {
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Still);
    view.set_environment_map(environment_map);
    view.set_scene(scene, false);
    settle(&mut view);
    view.film().unwrap()
}

/// The picture toward `direction`, between its four nearest pixels' centres.
fn looked_up(environment_map: &EnvironmentMap, direction: DVec3) -> DVec3 {
    let [width, height] = environment_map.size_px().map(|side| side as i64);
    let [u, v] = uv_from_direction(direction);
    let (x, y) = (u * width as f64 - 0.5, v * height as f64 - 0.5);
    let pixel = |dx: i64, dy: i64| {
        let column = (x.floor() as i64 + dx).rem_euclid(width);
        let row = (y.floor() as i64 + dy).clamp(0, height - 1);
        environment_map.pixels()[(row * width + column) as usize].as_dvec3()
    };
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let upper = pixel(0, 0).lerp(pixel(1, 0), fx);
    upper.lerp(pixel(0, 1).lerp(pixel(1, 1), fx), fy)
}

/// World-space direction of the ray through a pixel's centre, in f64.
fn ray(camera: &Camera, x: u32, y: u32) -> DVec3 {
    let [width, height] = SIZE.map(f64::from);
    let half = camera.half_height(width / height);
    let right = (2.0 * (f64::from(x) + 0.5) / width - 1.0) * half * width / height;
    let up = (1.0 - 2.0 * (f64::from(y) + 0.5) / height) * half;
    (camera.rotation() * DVec3::new(right, up, -1.0)).normalize()
}

#[test]
fn the_background_is_the_picture_in_every_direction() {
    let environment_map = colourful([128, 64]);
    // Its middle, across its left and right edges, straight up, down, and in between.
    for toward in [DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z, DVec3::new(1.0, -0.3, 0.4)] {
        for (rotation_deg, frame) in
            [(0.0, LightFrame::Scene), (130.0, LightFrame::Scene), (-40.0, LightFrame::View)]
        {
            let mut scene = away(toward);
            scene.lights.rig.intensity = 0.5;
            scene.lights.rig.frame = frame;
            scene.lights.rig.environment_map.rotation_deg = rotation_deg;
            let seen = film(&scene, Some(&environment_map));
            let mut turn = DQuat::from_rotation_z(f64::to_radians(rotation_deg));
            if frame == LightFrame::View {
                turn = scene.camera.rotation() * turn;
            }
            for (i, pixel) in (0..).zip(&seen) {
                let direction = ray(&scene.camera, i % SIZE[0], i / SIZE[0]);
                let expected = 0.5 * looked_up(&environment_map, turn.inverse() * direction);
                let got = DVec3::from_array(pixel.map(f64::from));
                // Nine bits a channel, eight between pixels.
                let off = (got - expected).abs().max_element();
                assert!(off < 0.03, "{toward} {rotation_deg}°, pixel {i}: {got}, not {expected}");
            }
        }
    }
}

#[test]
fn without_its_picture_the_background_is_the_gradient() {
    let mut scene = away(DVec3::Y);
    let mut plain = scene.clone();
    plain.background.kind = BackgroundKind::Gradient;
    let gradient = film(&plain, None);
    assert_eq!(film(&scene, None), gradient);
    assert_eq!(film(&plain, Some(&colourful([8, 4]))), gradient);
    scene.lights.rig.environment_map.name = "another.hdr".into();
    assert_eq!(film(&scene, Some(&colourful([8, 4]))), gradient);
}

#[test]
fn a_picture_that_comes_later_is_seen_and_can_go_again() {
    let scene = away(DVec3::Y);
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    let gradient = view.film().unwrap();
    let before = view.dispatches().clone();
    for (environment_map, is_seen) in
        [(Some(colourful([32, 16])), true), (Some(colourful([16, 8])), true), (None, false)]
    {
        view.set_environment_map(environment_map.as_ref());
        // The page gives the same scene again in every frame.
        view.set_scene(&scene, false);
        settle(&mut view);
        assert_eq!(view.film().unwrap() != gradient, is_seen);
    }
    let cost = view.dispatches().since(&before);
    assert_eq!(cost.of(&march::PASS), Count::default(), "no camera ray for a background");
}

#[test]
fn a_rigs_lights_shine_like_those_of_a_list() {
    for frame in [LightFrame::Scene, LightFrame::View] {
        let mut by_rig = sampled(Scene::default(), 1);
        by_rig.lights.environment.clear();
        by_rig.lights.rig =
            Rig { kind: RigKind::Sky, count: 9, intensity: 1.3, frame, ..Rig::default() };
        let mut by_list = by_rig.clone();
        by_list.lights.rig.kind = RigKind::None;
        by_list.lights.environment = by_rig
            .lights
            .rig
            .lights()
            .into_iter()
            .map(|(direction, strength)| {
                let intensity = strength.max_element();
                EnvironmentLight {
                    direction: direction.to_array(),
                    color: (strength / intensity).as_vec3().to_array(),
                    intensity,
                    shadow_reach: by_rig.lights.rig.shadow_reach,
                    frame,
                    ..EnvironmentLight::default()
                }
            })
            .collect();
        let [a, b] = [&by_rig, &by_list].map(|scene| film(scene, None));
        let off = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 1e-4);
        let mut dark = by_rig.clone();
        dark.lights.rig.muted = true;
        assert!(still(&dark, SIZE) != still(&by_rig, SIZE));
        // Something else solo puts the rig out, and the rig solo puts out the rest.
        by_rig.lights.environment.push(EnvironmentLight { solo: true, ..Default::default() });
        let list_alone = film(&by_rig, None);
        by_rig.lights.rig.kind = RigKind::None;
        assert_eq!(film(&by_rig, None), list_alone);
    }
}

#[test]
fn a_rig_edit_marches_no_camera_ray() {
    let mut scene = sampled(Scene::default(), 1);
    scene.lights.rig.kind = RigKind::Sky;
    let mut view = finished(&scene, SIZE, Pace::Interactive);
    let before = view.dispatches().of(&march::PASS);
    let edits: [fn(&mut Rig); 6] = [
        |rig| rig.count = 5,
        |rig| rig.sky.sun_strength = 4.0,
        |rig| rig.sky.zenith = [1.0, 0.0, 0.0],
        |rig| rig.intensity = 0.2,
        |rig| rig.frame = LightFrame::View,
        |rig| rig.light_by(&colourful([32, 16]), 20),
    ];
    for edit in edits {
        let shown = pixels(&view);
        edit(&mut scene.lights.rig);
        view.set_scene(&scene, false);
        settle(&mut view);
        assert!(pixels(&view) != shown);
        assert_eq!(view.dispatches().of(&march::PASS), before);
    }
}
