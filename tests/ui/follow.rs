//! Lights that follow the view: their switch, and edits of what is seen at depth.

use egui::{accesskit::Role, vec2};
use egui_kittest::kittest::Queryable as _;
use glam::DVec3;
use mandelight::{
    scene::{LightFrame, Scene, follow, presets},
    ui::Settings,
};

use crate::stage::*;

/// The opening scene, seen from the view unit `unit` and from behind its lights.
fn close_scene(unit: f64) -> Scene {
    let mut scene = presets::opening();
    let camera = &mut scene.camera;
    camera.pivot = camera.pivot.moved_by(DVec3::new(0.3, 0.7, 0.2), 0.0);
    camera.position = camera.pivot.moved_by(camera.forward() * -unit, 0.0);
    scene
}

#[test]
fn the_switch_is_one_step() {
    let mut harness = stage(Scene::default(), unfolded(), [1280.0, 4000.0]);
    harness.get_by_role_and_label(Role::CheckBox, "Follow close views").click();
    harness.run();
    assert!(scene(&harness).lights.follow_view);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), Scene::default());
}

#[test]
fn turning_a_light_at_depth_keeps_the_others_and_is_one_step() {
    for (unit, settings) in [(1e-6, unfolded()), (3e-3, unfolded()), (1e-6, Settings::default())] {
        let start = close_scene(unit);
        let seen = follow::shown(&start.lights, &start.camera).expect("a close view");
        let is_unfolded = settings.more_open;
        let mut harness = stage(start.clone(), settings, [1280.0, 4000.0]);
        harness.run();
        assert_eq!(*scene(&harness), start, "showing the lights edits nothing");
        let name = if is_unfolded { "light ball" } else { "key light ball" };
        let ball = harness.state().interface.rects().get(name).expect("the ball is there");
        // The ball's dot is where the light is seen: a press on it alone turns nothing.
        let key = seen.environment[0].direction.map(|v| v as f32);
        let radius = ball.width() / 2.0 - 6.0;
        let dot = ball.center() + vec2(key[0], -key[1]) * radius;
        drag(&mut harness, dot, dot, 1);
        assert_eq!(*scene(&harness), start, "at {unit:e}");
        drag(&mut harness, dot, dot + vec2(0.5, 0.2) * radius, 8);
        let lights = &scene(&harness).lights;
        assert!(!lights.follow_view && lights.environment[0].frame == LightFrame::View);
        let wanted = DVec3::from_array(seen.environment[0].direction) + DVec3::new(0.5, -0.2, 0.0);
        let turned = DVec3::from_array(lights.environment[0].direction);
        assert!(turned.truncate().distance(wanted.truncate()) < 0.02, "{turned} for {wanted}");
        // They shine on as they did.
        let shining = follow::effective(&start.lights, &start.camera);
        assert_eq!(lights.environment[1..], shining.environment[1..]);
        assert_eq!(undo_all(&mut harness), 1);
        assert_eq!(*scene(&harness), start);
    }
}

#[test]
fn a_strength_at_depth_changes_nothing_else() {
    let start = close_scene(1e-6);
    let mut harness = stage(start.clone(), unfolded(), [1280.0, 4000.0]);
    press(&mut harness, "Light 2");
    let sliders: Vec<_> = harness.get_all_by_role_and_label(Role::Slider, "Intensity").collect();
    sliders[0].set_value_accesskit(2.0);
    drop(sliders);
    harness.run();
    let mut expected = start;
    expected.lights.environment[1].intensity = scene(&harness).lights.environment[1].intensity;
    assert!((expected.lights.environment[1].intensity - 2.0).abs() < 1e-9);
    assert_eq!(*scene(&harness), expected);
}
