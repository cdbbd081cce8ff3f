//! The rig's panel, and the environment map that comes from outside.

use std::sync::Arc;

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use mandelight::{
    scene::{BackgroundKind, EnvironmentMap, MAX_LIGHTS, RigKind, Scene},
    ui::Action,
};

use crate::stage::*;

fn environment_map(name: &str) -> Arc<EnvironmentMap> {
    Arc::new(EnvironmentMap::from_fn(name, [64, 32], |to| DVec3::new(1.0 + to.x, 1.0, 1.5 + to.z)))
}

#[test]
fn a_picture_lights_the_scene_in_one_step_of_the_history() {
    let mut harness = workshop();
    harness.state_mut().interface.use_environment_map(environment_map("garden.hdr"));
    harness.run();
    let lit = scene(&harness).clone();
    assert_eq!(lit.validate(), Ok(()));
    assert_eq!(lit.lights.rig.kind, RigKind::EnvironmentMap);
    assert_eq!(lit.lights.rig.environment_map.name, "garden.hdr");
    assert_eq!(lit.background.kind, BackgroundKind::EnvironmentMap);
    assert!(harness.state().interface.environment_map().is_some());
    // The same again changes nothing, and needs no undoing.
    harness.state_mut().interface.use_environment_map(environment_map("garden.hdr"));
    assert_eq!(*scene(&harness), lit);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), Scene::default());
    assert!(harness.state().interface.environment_map().is_none(), "the scene names it no longer");
}

#[test]
fn another_number_of_lights_divides_the_picture_anew() {
    let mut harness = workshop();
    harness.state_mut().interface.use_environment_map(environment_map("garden.hdr"));
    harness.run();
    for (wanted, expected) in [(5.0, 5), (30.0, 30), (64.0, MAX_LIGHTS - 3)] {
        slider(&harness, "Sky lights").set_value_accesskit(wanted);
        harness.run();
        assert_eq!(scene(&harness).lights.rig.environment_map.lights.len(), expected);
        assert_eq!(scene(&harness).validate(), Ok(()));
    }
}

#[test]
fn without_its_picture_a_rig_keeps_its_lights() {
    let mut lit = Scene::default();
    lit.surround_by(&environment_map("garden.hdr"));
    let mut harness = stage(lit.clone(), unfolded(), [1280.0, 4000.0]);
    harness.run();
    harness.get_by_label_contains("garden.hdr is not loaded");
    let rail = harness.get_by_role_and_label(Role::Slider, "Sky lights");
    assert!(rail.accesskit_node().is_disabled());
    assert_eq!(*scene(&harness), lit);
    press(&mut harness, "Choose environment map…");
    assert_eq!(harness.state().actions, [Action::ChooseEnvironmentMap]);
}

#[test]
fn a_rig_never_brings_more_lights_than_a_scene_can_hold() {
    let mut crowded = Scene::default();
    let light = crowded.lights.environment[0].clone();
    crowded.lights.environment.resize(MAX_LIGHTS - 10, light.clone());
    let mut harness = stage(crowded.clone(), unfolded(), [1280.0, 4000.0]);
    press(&mut harness, "Sky light: Sky");
    assert_eq!(scene(&harness).validate(), Ok(()));
    assert_eq!(scene(&harness).lights.len(), MAX_LIGHTS);
    // Where there is no room at all, it stays as it was.
    crowded.lights.environment.resize(MAX_LIGHTS - 2, light);
    let mut harness = stage(crowded.clone(), unfolded(), [1280.0, 4000.0]);
    press(&mut harness, "Sky light: Sky");
    assert_eq!(*scene(&harness), crowded);
}

#[test]
fn a_background_picture_can_be_taken_away_whatever_lights_the_scene() {
    let mut lit = Scene::default();
    lit.surround_by(&environment_map("garden.hdr"));
    let mut harness = stage(lit, unfolded(), [1280.0, 4000.0]);
    for rig in ["Sky light: Environment map", "Sky light: Sky", "Sky light: None"] {
        press(&mut harness, rig);
        for expected in [BackgroundKind::Gradient, BackgroundKind::EnvironmentMap] {
            harness.get_by_label("Show the map behind the fractal").click();
            harness.run();
            assert_eq!(scene(&harness).background.kind, expected, "{rig}");
        }
    }
}
