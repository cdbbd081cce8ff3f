//! The interface deep in the set: what is shown and set there in numbers that people read.

use egui::Key;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use mandelight::{
    scene::{Camera, LightFrame, PrecisePoint, RigKind, Scene, param},
    ui::Settings,
};

use crate::stage::*;

const UNIT: f64 = 1e-20;

/// A view deep in the set, at a place that no f64 can tell from its neighbours.
fn deep_scene() -> Scene {
    let place = ["0.612345678901234567890123456789", "-0.3", "0.4987654321098765432109876543211"];
    let pivot = PrecisePoint(place.map(|text| text.parse().expect("a number")));
    let back = DVec3::new(0.3, -0.8, 0.5).normalize();
    let camera = Camera {
        position: pivot.moved_by(back * UNIT, 0.0),
        pivot,
        ..Camera::looking_at(back, DVec3::ZERO, DVec3::Z)
    };
    Scene { camera, ..Default::default() }
}

#[test]
fn a_point_light_added_at_depth_is_in_view_and_reads_well() {
    let mut harness = stage(deep_scene(), unfolded(), [1280.0, 4000.0]);
    harness.run();
    press(&mut harness, "Add point light");
    let light = scene(&harness).lights.point[0].clone();
    let camera = &scene(&harness).camera;
    let offset = camera.rotation().inverse() * (&light.position - &camera.position);
    assert!((-UNIT..-0.1 * UNIT).contains(&offset.z), "{offset} is not before the eye");
    // A light half a view unit from the pivot that lights it to 1 has a quarter at one view unit.
    assert!((light.intensity / UNIT.powi(2) - 0.25).abs() < 1e-9, "{}", light.intensity);
    harness.get_by_label_contains("view units from you");
    harness.get_by_label("Point light 1 in the view");
    slider(&harness, "Intensity").set_value_accesskit(2.0);
    harness.run();
    let set = scene(&harness).lights.point[0].intensity;
    assert!((set / UNIT.powi(2) - 2.0).abs() < 1e-9, "{set:e}");
    assert_eq!(scene(&harness).validate(), Ok(()));
    assert_eq!(undo_all(&mut harness), 2);
    assert_eq!(*scene(&harness), deep_scene());
}

#[test]
fn looking_at_a_deep_light_changes_nothing() {
    let mut lit = deep_scene();
    let position = lit.camera.pivot.moved_by(DVec3::Z * 0.3 * UNIT, 0.0);
    let light =
        mandelight::scene::PointLight { position, intensity: 0.7e-40 / 3.0, ..Default::default() };
    lit.lights.point.push(light);
    lit.lights.environment.clear();
    let mut harness = stage(lit.clone(), unfolded(), [1280.0, 4000.0]);
    harness.run_steps(10);
    assert_eq!(*scene(&harness), lit);
}

#[test]
fn one_click_lights_what_is_in_view() {
    for mut scene_before in [Scene::default(), deep_scene()] {
        scene_before.lights.rig.shadow_reach = None;
        let mut harness = stage(scene_before.clone(), unfolded(), [1280.0, 4000.0]);
        harness.run();
        press(&mut harness, "Light what is in view");
        let rig = &scene(&harness).lights.rig;
        assert_eq!((rig.kind, rig.frame), (RigKind::Sky, LightFrame::View));
        assert_eq!(rig.shadow_reach, Some(param::RIG_SHADOW_REACH.default));
        assert_eq!(rig.sky.sun_direction.map(f64::signum), [-1.0, 1.0, 1.0], "over the shoulder");
        assert_eq!(scene(&harness).validate(), Ok(()));
        assert!(button(&harness, "Light what is in view").accesskit_node().is_disabled());
        assert_eq!(undo_all(&mut harness), 1);
        assert_eq!(*scene(&harness), scene_before);
    }
}

#[test]
fn the_way_home_from_depth_is_one_step_of_the_history() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
    harness.run();
    let home = scene(&harness).camera.clone();
    *harness.state_mut().interface.editor_mut() =
        mandelight::ui::editor::Editor::new(deep_scene().into());
    harness.run();
    harness.key_press(Key::H);
    harness.run_steps(30);
    let unit = scene(&harness).camera.view_unit();
    assert!((1e-19..1e-10).contains(&unit), "half a second away from {UNIT:e}: {unit:e}");
    harness.run_steps(400);
    assert_eq!(scene(&harness).camera, home);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), deep_scene());
}

#[test]
fn home_leads_out_of_a_deep_opening_view_and_back_again() {
    let mut harness = stage(deep_scene(), Settings::default(), [1280.0, 720.0]);
    harness.run();
    button(&harness, "Out").click();
    harness.run_steps(60);
    let unit = scene(&harness).camera.view_unit();
    assert!((1e-19..0.1).contains(&unit), "a second away: {unit:e}");
    harness.run_steps(400);
    let unit = scene(&harness).camera.view_unit();
    assert!(unit > 1.0, "{unit:e}");
    button(&harness, "Home").click();
    harness.run_steps(400);
    assert_eq!(scene(&harness).camera, deep_scene().camera);
    assert_eq!(undo_all(&mut harness), 2);
}

#[test]
fn who_comes_by_a_link_to_a_dive_finds_the_others() {
    for (scene, listed, other) in
        [(deep_scene(), "Dahlia", "Coral reef"), (Scene::default(), "Coral reef", "Dahlia")]
    {
        let mut harness = stage(scene, Settings::default(), [1280.0, 720.0]);
        harness.run();
        harness.get_by_label(listed);
        assert!(harness.query_by_label(other).is_none());
        // It stays as it is while the view goes elsewhere.
        harness.key_press(Key::A);
        harness.run_steps(400);
        harness.get_by_label(listed);
    }
}
