//! The lens's focus: by the key, by Alt + click, by the panel's button.

use egui::{Key, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::{Harness, kittest::Queryable as _};
use glam::{DVec2, DVec3};
use mandelight::{fractal::camera_ray, scene::Scene};

use crate::stage::*;

/// The window's width and height, and the picture's, left of the panel.
const WINDOW: [f32; 2] = [1280.0, 1600.0];

fn focused() -> Harness<'static, Stage> {
    stage(Scene::default(), unfolded(), WINDOW)
}

/// How far the surface is from the plane of focus, along the ray through `ndc`, in view units.
fn off_focus(scene: &Scene, ndc: DVec2, aspect: f64) -> f64 {
    let camera = &scene.camera;
    let field = scene.fractal.distance_field();
    let ray = camera_ray::camera_ray(camera, &field.origin(), ndc, aspect);
    let depth = field.march(ray, 2.5e-4, 1e3).expect("a surface");
    let along: DVec3 = ray.direction * depth;
    (along.dot(camera.forward()) / camera.view_unit() - camera.lens.focus).abs()
}

#[test]
fn the_key_and_the_button_focus_on_the_middle() {
    let mut by_key = focused();
    by_key.key_press(Key::O);
    by_key.run();
    let mut by_button = focused();
    for label in ["Depth of field", "Focus on the middle"] {
        // The keyboard brings the control into the window.
        by_button.get_by_label(label).focus();
        by_button.run();
        by_button.get_by_label(label).click();
        by_button.run();
    }
    for harness in [by_key, by_button] {
        let scene = scene(&harness);
        assert!(scene.camera.lens.depth_of_field);
        assert!(scene.camera.lens.focus < 0.95, "{}", scene.camera.lens.focus);
        let off = off_focus(scene, DVec2::ZERO, 1.0);
        assert!(off < 1e-2, "{off} view units off {}", scene.camera.lens.focus);
    }
}

#[test]
fn a_click_with_alt_focuses_there_and_moves_nothing() {
    let mut harness = focused();
    let before = scene(&harness).camera.clone();
    let at: Pos2 = pos2(420.0, 700.0);
    harness.event(egui::Event::ModifiersChanged(Modifiers::ALT));
    harness.event(egui::Event::PointerMoved(at));
    harness.step();
    for pressed in [true, false] {
        pointer(&harness, at, PointerButton::Primary, pressed, Modifiers::ALT);
        harness.step();
    }
    harness.run();
    let camera = &scene(&harness).camera;
    assert!(camera.lens.depth_of_field);
    assert_ne!(camera.lens.focus, before.lens.focus);
    assert_eq!((&camera.position, &camera.orientation), (&before.position, &before.orientation));
    // On the background nothing changes.
    let focus = camera.lens.focus;
    let at = pos2(8.0, 60.0);
    harness.event(egui::Event::PointerMoved(at));
    harness.step();
    for pressed in [true, false] {
        pointer(&harness, at, PointerButton::Primary, pressed, Modifiers::ALT);
        harness.step();
    }
    assert_eq!(scene(&harness).camera.lens.focus, focus);
}
