//! Section planes, made and moved in the panel and in the view.

use egui::{accesskit::Role, vec2};
use egui_kittest::{Harness, kittest::Queryable as _};
use glam::DVec3;
use mandelight::{
    formula::section::SectionPlane,
    scene::{Scene, presets},
};

use crate::stage::*;

fn planes<'h>(harness: &'h Harness<'_, Stage>) -> &'h [SectionPlane] {
    &scene(harness).fractal.section_planes
}

fn opened(scene: Scene) -> Harness<'static, Stage> {
    let mut harness = stage(scene, unfolded(), [1280.0, 5000.0]);
    press(&mut harness, "Cut open");
    harness
}

#[test]
fn cuts_face_the_eye_and_are_removed_again() {
    let mut harness = opened(Scene::default());
    for count in 1..=3 {
        assert_eq!(planes(&harness).len(), count);
        let toward_eye = scene(&harness).camera.position.to_dvec3();
        assert!(planes(&harness)[count - 1].normal().dot(toward_eye) > 0.0);
        press(&mut harness, "Another plane");
    }
    assert_eq!(planes(&harness).len(), 3, "no fourth plane");
    let mut normals: Vec<_> =
        planes(&harness).iter().map(|plane| plane.normal().abs().to_array()).collect();
    normals.sort_by(|a, b| b.partial_cmp(a).expect("numbers"));
    assert_eq!(normals, [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis.to_array()));
    for name in ["Remove plane 3", "Remove plane 1", "Remove plane 1"] {
        press(&mut harness, name);
    }
    assert!(planes(&harness).is_empty());
    assert_eq!(scene(&harness).validate(), Ok(()));
}

#[test]
fn planes_turn_and_move() {
    let mut harness = opened(Scene::default());
    press(&mut harness, "Facing you");
    let forward = scene(&harness).camera.forward();
    assert!((planes(&harness)[0].normal() + forward).length() < 1e-9);
    press(&mut harness, "Other half");
    assert!((planes(&harness)[0].normal() - forward).length() < 1e-9);
    // The positions of a gradient's stops come after it.
    let mut positions = harness.query_all_by_role_and_label(Role::Slider, "Position");
    positions.next().expect("a slider").set_value_accesskit(0.25);
    drop(positions);
    harness.run();
    let plane = &planes(&harness)[0];
    assert!((plane.point.to_dvec3() - 0.25 * plane.normal()).length() < 1e-5);
    assert_eq!(scene(&harness).validate(), Ok(()));
}

#[test]
fn a_handle_moves_its_plane_along_the_normal() {
    let mut harness = opened(Scene::default());
    let before = planes(&harness)[0].clone();
    let from = harness.get_by_label("Section plane 1 in the view").rect().center();
    drag(&mut harness, from, from + vec2(-40.0, 30.0), 4);
    let plane = &planes(&harness)[0];
    let moved = &plane.point - &before.point;
    assert!(moved.length() > 0.01, "{moved}");
    assert!(moved.normalize().dot(before.normal()).abs() > 1.0 - 1e-9, "{moved}");
    assert_eq!(undo_all(&mut harness), 2, "the plane, and one drag");
}

#[test]
fn dives_are_cut_at_what_they_show() {
    let dive = presets::dives().last().expect("a dive");
    let harness = opened((dive.scene)());
    let camera = &scene(&harness).camera;
    let plane = &planes(&harness)[0];
    assert_eq!(plane.point, camera.pivot);
    assert!(plane.band_reach <= camera.view_unit());
    assert_eq!(scene(&harness).validate(), Ok(()));
}
