//! Handles of lights in the view: they follow the pointer, and show while a person works on lights.

use egui::{Key, Modifiers, vec2};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    scene::{RigKind, Scene, follow, light_setups::SETUPS, presets},
    ui::Settings,
};

use crate::stage::*;

/// A stage with the lights' section open, and a square view.
fn opened(scene: Scene) -> Harness<'static, Stage> {
    let mut settings = Settings { more_open: true, ..Settings::default() };
    settings.sections.set_open("lights", true);
    without_motion(stage(scene, settings, [1280.0, 720.0]))
}

#[test]
fn a_handle_turns_its_light_and_stays_under_the_pointer() {
    let mut harness = opened(Scene::default());
    let before = scene(&harness).clone();
    let place =
        |harness: &Harness<'_, Stage>| harness.get_by_label("Light 1 in the view").rect().center();
    let from = place(&harness);
    let by = vec2(-60.0, 45.0);
    drag(&mut harness, from, from + by, 6);
    let moved = place(&harness) - from;
    assert!((moved - by).length() < 2.0, "{moved}");
    let after = scene(&harness).clone();
    assert_ne!(after.lights.environment[0].direction, before.lights.environment[0].direction);
    let mut lights = after.lights.clone();
    lights.environment[0].direction = before.lights.environment[0].direction;
    assert_eq!(Scene { lights, ..after }, before, "only the direction changes");
    assert_eq!(undo_all(&mut harness), 1, "a drag is one step");
}

#[test]
fn a_handle_past_the_rim_is_behind_and_arrows_turn_it() {
    let mut harness = opened(Scene::default());
    let view = harness.get_by_label("View").rect();
    let from = harness.get_by_label("Light 1 in the view").rect().center();
    let out = view.center() + (from - view.center()).normalized() * 0.55 * view.size().min_elem();
    drag(&mut harness, from, out, 8);
    let z = |harness: &Harness<'_, Stage>| {
        let Scene { camera, lights, .. } = scene(harness);
        lights.environment[0].toward_light_in_view(camera).z
    };
    assert!(z(&harness) < 0.0, "{}", z(&harness));
    let before = scene(&harness).lights.clone();
    harness.get_by_label("Light 1 in the view").focus();
    harness.run();
    harness.key_press(Key::ArrowRight);
    harness.run();
    assert_ne!(scene(&harness).lights, before);
}

#[test]
fn lights_that_follow_the_view_turn_as_they_are_seen() {
    let mut close = presets::opening();
    close.camera.position = close.camera.pivot.moved_by(close.camera.forward() * -1e-6, 0.0);
    assert!(follow::shown(&close.lights, &close.camera).is_some(), "its lights have turned");
    let mut harness = opened(close);
    let name = "Light 1 in the view";
    let from = harness.get_by_label(name).rect().center();
    drag(&mut harness, from, from + vec2(30.0, 20.0), 4);
    let moved = harness.get_by_label(name).rect().center() - from;
    assert!((moved - vec2(30.0, 20.0)).length() < 2.0, "{moved}");
    assert!(!scene(&harness).lights.follow_view, "turning a light ends the following");
}

/// A stage of the opening scene, whose lights are all directional, with the panel as at a first visit.
fn first_visit() -> Harness<'static, Stage> {
    without_motion(stage(presets::opening(), Settings::default(), [1280.0, 1000.0]))
}

fn has_handle(harness: &Harness<'_, Stage>) -> bool {
    harness.query_by_label("Light 1 in the view").is_some()
}

#[test]
fn the_picture_has_no_handles_while_lights_are_not_in_use() {
    let mut harness = first_visit();
    assert!(!has_handle(&harness));
    let rects = harness.state().interface.rects();
    let elsewhere = ["power", "view"].map(|name| rects.get(name).expect(name).center());
    for at in elsewhere {
        harness.event(egui::Event::PointerMoved(at));
        harness.run_steps(3);
        assert!(!has_handle(&harness), "{at}");
    }
}

#[test]
fn the_key_light_s_controls_show_handles_which_stay_to_be_reached() {
    let mut harness = first_visit();
    let rects = harness.state().interface.rects();
    let [ball, view] = ["key light ball", "view"].map(|name| rects.get(name).expect(name));
    harness.event(egui::Event::PointerMoved(ball.center()));
    harness.run_steps(3);
    assert!(has_handle(&harness));
    // The pointer needs some seconds to the handle, which then turns the light.
    let handle = harness.get_by_label("Light 1 in the view").rect().center();
    harness.event(egui::Event::PointerMoved(view.right_center() - vec2(20.0, 0.0)));
    harness.run_steps(180);
    let before = scene(&harness).lights.environment[0].direction;
    drag(&mut harness, handle, handle + vec2(-40.0, 30.0), 6);
    assert_ne!(scene(&harness).lights.environment[0].direction, before);
    // A handle in use stays; after its use, handles go.
    harness.run_steps(600);
    assert!(has_handle(&harness), "the pointer is at the handle");
    harness.event(egui::Event::PointerMoved(view.right_center() - vec2(20.0, 0.0)));
    harness.get_by_label("Power").focus();
    harness.run_steps(420);
    assert!(!has_handle(&harness), "7 seconds later");
}

/// Each of its lights has one, and each handle moves its light alone.
#[test]
fn a_light_setup_that_was_chosen_has_handles() {
    for setup in SETUPS {
        let mut harness = first_visit();
        press(&mut harness, "Looks: Lights");
        assert!(!has_handle(&harness));
        button(&harness, &format!("Light: {}", setup.name)).click();
        harness.run_steps(6);
        let chosen = scene(&harness).lights.clone();
        assert_ne!(chosen, presets::opening().lights, "{}", setup.name);
        let handles: Vec<String> = harness
            .root()
            .children_recursive()
            .filter_map(|node| node.accesskit_node().label())
            .filter(|label| label.ends_with(" in the view"))
            .collect();
        let lights = chosen.environment.len() + chosen.point.len();
        let suns = usize::from(chosen.rig.kind == RigKind::Sky);
        assert_eq!(handles.len(), lights + suns, "{}: {handles:?}", setup.name);
        for handle in handles {
            let before = scene(&harness).lights.clone();
            harness.get_by_label(&handle).focus();
            harness.run_steps(2);
            harness.key_press(Key::ArrowRight);
            harness.run_steps(3);
            let after = scene(&harness).lights.clone();
            let (old, new) = (&before, &after);
            let moved =
                old.environment.iter().zip(&new.environment).filter(|(a, b)| a != b).count()
                    + old.point.iter().zip(&new.point).filter(|(a, b)| a != b).count()
                    + usize::from(old.rig != new.rig);
            assert_eq!(moved, 1, "{handle} of {}", setup.name);
            harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
            harness.run_steps(3);
            assert_eq!(scene(&harness).lights, before, "{handle} of {} is one step", setup.name);
        }
    }
}

/// A scene that only its sky lights has the sun for its key light.
#[test]
fn the_key_light_s_ball_moves_the_sun_of_a_sky() {
    let mut harness = first_visit();
    press(&mut harness, "Looks: Lights");
    button(&harness, "Light: Sky").click();
    harness.run_steps(6);
    let before = scene(&harness).lights.clone();
    assert!(before.environment.is_empty());
    harness.get_by_label("Drag the dot to move the sun.");
    let ball = harness.state().interface.rects().get("key light ball").expect("the ball");
    drag(&mut harness, ball.center(), ball.center() + vec2(12.0, -8.0), 4);
    let after = scene(&harness).lights.clone();
    assert_ne!(after.rig.sky.sun_direction, before.rig.sky.sun_direction);
    assert_eq!(after.environment, before.environment);
}

#[test]
fn the_keyboard_at_the_ball_shows_handles_too() {
    let mut harness = first_visit();
    harness.get_by_label("Key light direction").focus();
    harness.run_steps(3);
    assert!(has_handle(&harness));
}

/// The keyboard's focus stays at the ball after a drag, which is no use of it.
#[test]
fn handles_go_after_a_drag_of_the_key_light_s_ball() {
    let mut harness = first_visit();
    let rects = harness.state().interface.rects();
    let [ball, view] = ["key light ball", "view"].map(|name| rects.get(name).expect(name));
    drag(&mut harness, ball.center(), ball.center() + vec2(12.0, -8.0), 4);
    assert!(has_handle(&harness));
    harness.event(egui::Event::PointerMoved(view.right_center() - vec2(20.0, 0.0)));
    harness.run_steps(420);
    assert!(!has_handle(&harness), "7 seconds later");
    let delay = harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert!(delay.as_secs_f64() > 60.0, "an idle page draws again after {delay:?}");
    // A key at the ball is a use.
    harness.get_by_label("Key light direction").focus();
    harness.run_steps(420);
    assert!(!has_handle(&harness));
    harness.key_press(Key::ArrowRight);
    harness.run_steps(3);
    assert!(has_handle(&harness));
}

#[test]
fn handles_show_while_a_place_to_light_is_awaited() {
    let mut harness = first_visit();
    // The window is too low to show the button at once.
    button(&harness, "Light a place").focus();
    harness.run();
    press(&mut harness, "Light a place");
    let view = harness.state().interface.rects().get("view").expect("the view");
    harness.event(egui::Event::PointerMoved(view.right_center() - vec2(20.0, 0.0)));
    harness.run_steps(480);
    let caption = harness.state().interface.rects().get("light click");
    assert!(caption.is_some(), "a place is awaited");
    assert!(has_handle(&harness));
}

/// From the eye to the first point light, in the eye's axes.
fn seen(harness: &Harness<'_, Stage>) -> glam::DVec3 {
    let Scene { camera, lights, .. } = scene(harness);
    camera.rotation().inverse() * (&lights.point[0].position - &camera.position)
}

#[test]
fn arrows_move_a_point_light_from_its_handle_and_from_its_row() {
    for name in ["Point light 1 in the view", "Point 1"] {
        let mut harness = opened(Scene::default());
        button(&harness, "Add point light").click_accesskit();
        harness.run();
        let begun = seen(&harness);
        let press_key = |harness: &mut Harness<'_, Stage>, modifiers, key| {
            let control = harness.get_by_label(name);
            control.focus();
            harness.run();
            let before = seen(harness);
            harness.key_press_modifiers(modifiers, key);
            harness.run();
            seen(harness) - before
        };
        let (none, shift) = (Modifiers::NONE, Modifiers::SHIFT);
        let right = press_key(&mut harness, none, Key::ArrowRight);
        assert!(right.x > 1e-3 && right.y.abs() + right.z.abs() < 1e-4, "{name}: {right}");
        let up = press_key(&mut harness, none, Key::ArrowUp);
        assert!(up.y > 1e-3 && up.x.abs() + up.z.abs() < 1e-4, "{name}: {up}");
        let away = press_key(&mut harness, shift, Key::ArrowUp);
        assert!(away.z < -1e-3 && away.cross(seen(&harness)).length() < 1e-4, "{name}: {away}");
        press_key(&mut harness, shift, Key::ArrowDown);
        press_key(&mut harness, none, Key::ArrowDown);
        press_key(&mut harness, none, Key::ArrowLeft);
        assert!((seen(&harness) - begun).length() < 1e-3, "{name}: back");
        assert_eq!(scene(&harness).camera, Scene::default().camera, "{name}: the view stays");
    }
}

#[test]
fn arrows_turn_a_directional_light_from_its_row() {
    let mut harness = opened(Scene::default());
    let direction = |harness: &Harness<'_, Stage>| {
        let Scene { camera, lights, .. } = scene(harness);
        lights.environment[0].toward_light_in_view(camera)
    };
    let before = direction(&harness);
    button(&harness, "Light 1").focus();
    harness.run();
    harness.key_press(Key::ArrowRight);
    harness.run();
    let turned = before.angle_between(direction(&harness)).to_degrees();
    assert!((1.0..=5.01).contains(&turned), "{turned} degrees");
    assert_eq!(scene(&harness).camera, Scene::default().camera, "the view stays");
}
