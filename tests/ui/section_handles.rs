//! Handles of section planes in the view: arrow keys move the planes along their arrows.

use egui::{Key, Modifiers};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{formula::section::SectionPlane, scene::Scene, ui::Settings};

use crate::stage::*;

#[test]
fn arrow_keys_move_a_section_plane_along_its_normal() {
    let mut opening = Scene::default();
    opening.fractal.section_planes.push(SectionPlane::default());
    let begun = opening.fractal.section_planes[0].clone();
    let mut settings = Settings { more_open: true, ..Settings::default() };
    settings.sections.set_open("section_planes", true);
    let mut harness = without_motion(stage(opening, settings, [1280.0, 720.0]));
    harness.get_by_label("Section plane 1 in the view").focus();
    harness.run();
    // How far the plane is from its first place, along its normal and across.
    let moved = |harness: &Harness<'_, Stage>| {
        let plane = &scene(harness).fractal.section_planes[0];
        assert_eq!(plane.direction, begun.direction);
        let by = &plane.point - &begun.point;
        let along = by.dot(begun.normal());
        (along, (by - along * begun.normal()).length())
    };
    let mut press_key = |modifiers, key| {
        harness.key_press_modifiers(modifiers, key);
        harness.run();
        moved(&harness)
    };
    let (none, shift) = (Modifiers::NONE, Modifiers::SHIFT);
    let (right, across) = press_key(none, Key::ArrowRight);
    assert!(right > 1e-3 && across < 1e-9, "{right} along, {across} across");
    let (up, _) = press_key(none, Key::ArrowUp);
    assert!((up - 2.0 * right).abs() < 0.02 * right, "{up} after {right}");
    press_key(none, Key::ArrowDown);
    let (back, _) = press_key(none, Key::ArrowLeft);
    assert!(back.abs() < 0.02 * right, "{back}");
    let (fine, _) = press_key(shift, Key::ArrowRight);
    assert!((fine - 0.1 * right).abs() < 0.03 * right, "{fine} of {right}");
    assert_eq!(scene(&harness).camera, Scene::default().camera, "the view stays");
}
