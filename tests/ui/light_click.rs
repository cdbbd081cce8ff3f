//! A click that lights a place.

use egui::{Key, Modifiers, PointerButton, Pos2, accesskit::Role, pos2};
use egui_kittest::{Harness, kittest::Queryable as _};
use glam::DVec3;
use mandelight::{
    scene::{PointLight, PrecisePoint, Scene, StereoLayout},
    ui::Settings,
};

use crate::stage::*;

/// A place of the surface, right of the middle, and one of the background.
const SURFACE: Pos2 = pos2(540.0, 330.0);
const BACKGROUND: Pos2 = pos2(20.0, 60.0);

fn lit(scene: Scene) -> Harness<'static, Stage> {
    without_motion(stage(scene, Settings::default(), [1280.0, 720.0]))
}

/// Presses the button, which the window is too low to show at once.
fn press_light_a_place(harness: &mut Harness<'_, Stage>) {
    button(harness, "Light a place").focus();
    harness.run();
    press(harness, "Light a place");
}

fn click(harness: &mut Harness<'_, Stage>, at: Pos2, modifiers: Modifiers) {
    harness.event(egui::Event::ModifiersChanged(modifiers));
    harness.event(egui::Event::PointerMoved(at));
    harness.step();
    for pressed in [true, false] {
        pointer(harness, at, PointerButton::Primary, pressed, modifiers);
        harness.step();
    }
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    harness.run();
}

#[test]
fn the_button_waits_for_one_click() {
    let mut harness = lit(Scene::default());
    let before = scene(&harness).clone();
    press_light_a_place(&mut harness);
    assert!(harness.query_by_label_contains("Click a place to light it").is_some());
    click(&mut harness, SURFACE, Modifiers::NONE);
    let after = scene(&harness).clone();
    assert_ne!(after.lights.environment[0], before.lights.environment[0]);
    let rest = Scene { lights: before.lights.clone(), ..after.clone() };
    assert_eq!(rest, before, "only the light moves");
    // The next click does nothing, and the light was one step.
    click(&mut harness, SURFACE, Modifiers::NONE);
    assert_eq!(*scene(&harness), after);
    assert_eq!(undo_all(&mut harness), 1);
}

/// Without any light the key light has no ball, but there is a way to a first light.
#[test]
fn a_dark_scene_gets_a_light_by_a_click() {
    let mut dark = Scene::default();
    dark.lights.environment.clear();
    let mut harness = lit(dark);
    harness.get_by_label("This scene has no key light.");
    assert!(harness.state().interface.rects().get("key light ball").is_none());
    press_light_a_place(&mut harness);
    click(&mut harness, SURFACE, Modifiers::NONE);
    assert_eq!(scene(&harness).lights.environment.len(), 1);
    harness.get_by_label("Drag the dot to move light 1.");
}

#[test]
fn enter_in_the_view_lights_its_middle() {
    let mut pointed = lit(Scene::default());
    let middle = pointed.state().interface.rects().get("view").expect("the view").center();
    press_light_a_place(&mut pointed);
    click(&mut pointed, middle, Modifiers::NONE);

    let mut harness = lit(Scene::default());
    press_light_a_place(&mut harness);
    harness.get_by_role_and_label(Role::Canvas, "View").focus();
    harness.run();
    assert!(harness.query_by_label_contains("Enter lights the middle").is_some());
    harness.key_press(Key::Enter);
    harness.run();
    let light = |harness: &Harness<'_, Stage>| scene(harness).lights.environment[0].clone();
    assert_ne!(light(&harness), Scene::default().lights.environment[0]);
    assert_eq!(light(&harness), light(&pointed));
}

/// The middle of one eye's picture, and Space is the path's.
#[test]
fn enter_lights_the_middle_of_an_eye_and_space_nothing() {
    let mut scene_of_pair = Scene::default();
    scene_of_pair.camera.stereo.layout = StereoLayout::SideBySide;
    let mut harness = lit(scene_of_pair);
    press_light_a_place(&mut harness);
    harness.get_by_role_and_label(Role::Canvas, "View").focus();
    harness.run();
    let before = scene(&harness).clone();
    harness.key_press(Key::Space);
    harness.run();
    assert_eq!(*scene(&harness), before);
    harness.key_press(Key::Enter);
    harness.run();
    let of_pair = scene(&harness).lights.environment[0].direction;
    let mut mono = before.clone();
    mono.camera.stereo.layout = Scene::default().camera.stereo.layout;
    let mut harness = lit(mono);
    press_light_a_place(&mut harness);
    harness.get_by_role_and_label(Role::Canvas, "View").focus();
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    let of_one = scene(&harness).lights.environment[0].direction;
    let apart = (DVec3::from_array(of_pair) - DVec3::from_array(of_one)).length();
    assert!(apart < 0.3, "{of_pair:?}, {of_one:?}");
}

#[test]
fn escape_ends_the_wait_and_the_background_takes_no_light() {
    let mut harness = lit(Scene::default());
    let before = scene(&harness).clone();
    press_light_a_place(&mut harness);
    harness.key_press(Key::Escape);
    harness.run();
    click(&mut harness, SURFACE, Modifiers::NONE);
    click(&mut harness, BACKGROUND, Modifiers::ALT | Modifiers::SHIFT);
    assert_eq!(*scene(&harness), before);
}

/// A point light comes so near that its light arrives, and stays as bright there.
#[test]
fn a_point_light_comes_along() {
    let mut far = Scene::default();
    far.lights.environment.clear();
    let position = PrecisePoint::from(DVec3::new(0.0, 60.0, 0.0));
    far.lights.point = vec![PointLight { position, muted: true, ..PointLight::default() }];
    let mut harness = lit(far);
    click(&mut harness, SURFACE, Modifiers::ALT | Modifiers::SHIFT);
    let after = scene(&harness);
    let light = &after.lights.point[0];
    let from_eye = (&light.position - &after.camera.position).length();
    assert!(from_eye < 3.0 * after.camera.view_unit(), "{from_eye}");
    assert!(!light.muted && light.intensity < PointLight::default().intensity, "{light:?}");
}
