//! Gestures in the view, the keyboard, and what one step of undo is.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, TouchDeviceId, TouchId, TouchPhase, vec2};
use egui_kittest::kittest::Queryable as _;
use mandelight::{
    formula::mandelbulb,
    scene::{Scene, param},
    ui::{Action, Settings, SheetHeight},
};

use crate::stage::*;

fn view_center(harness: &egui_kittest::Harness<'_, Stage>) -> Pos2 {
    harness.state().interface.rects().get("view").expect("the view is there").center()
}

fn window() -> egui_kittest::Harness<'static, Stage> {
    stage(Scene::default(), Settings::default(), [1280.0, 720.0])
}

#[test]
fn a_drag_orbits_and_is_one_step() {
    let mut harness = window();
    let center = view_center(&harness);
    drag(&mut harness, center, center + vec2(140.0, 30.0), 12);
    let start = Scene::default();
    assert_ne!(scene(&harness).camera.orientation, start.camera.orientation);
    assert_eq!(scene(&harness).fractal, start.fractal);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), start);
}

#[test]
fn a_slider_drag_is_one_step_and_two_drags_are_two() {
    let mut harness = window();
    let rail = slider(&harness, "Power").rect();
    drag(&mut harness, rail.center(), rail.center() + vec2(30.0, 0.0), 9);
    drag(&mut harness, rail.center(), rail.center() - vec2(30.0, 0.0), 9);
    assert_eq!(undo_all(&mut harness), 2);
    assert_eq!(*scene(&harness), Scene::default());
}

#[test]
fn a_drag_is_in_motion_and_rest_is_not() {
    let mut harness = window();
    let center = view_center(&harness);
    assert!(!harness.state().interface.is_moving());
    harness.event(Event::PointerMoved(center));
    pointer(&harness, center, PointerButton::Primary, true, Modifiers::NONE);
    for i in 1..10 {
        harness.event(Event::PointerMoved(center + vec2(8.0 * i as f32, 0.0)));
    }
    harness.step();
    assert!(harness.state().interface.is_moving());
    pointer(&harness, center, PointerButton::Primary, false, Modifiers::NONE);
    harness.step();
    assert!(!harness.state().interface.is_moving());
}

#[test]
fn a_right_drag_and_a_drag_with_shift_pan() {
    for (mouse, modifiers) in
        [(PointerButton::Secondary, Modifiers::NONE), (PointerButton::Primary, Modifiers::SHIFT)]
    {
        let mut harness = window();
        let center = view_center(&harness);
        harness.event(Event::ModifiersChanged(modifiers));
        harness.event(Event::PointerMoved(center));
        pointer(&harness, center, mouse, true, modifiers);
        for i in 1..10 {
            harness.event(Event::PointerMoved(center + vec2(8.0 * i as f32, 0.0)));
        }
        pointer(&harness, center + vec2(72.0, 0.0), mouse, false, modifiers);
        harness.run();
        let start = Scene::default().camera;
        let camera = &scene(&harness).camera;
        assert_eq!(camera.orientation, start.orientation, "panning does not turn");
        let moved = &camera.position - &start.position;
        assert!(moved.length() > 0.01, "panning moves the eye");
        assert!(moved.dot(start.forward()).abs() < 1e-6, "panning stays in the picture's plane");
    }
}

#[test]
fn the_wheel_comes_nearer_and_a_run_of_notches_is_one_step() {
    let mut harness = window();
    let center = view_center(&harness);
    let before = scene(&harness).camera.view_unit();
    harness.event(Event::PointerMoved(center));
    for _ in 0..3 {
        harness.event(wheel(100.0));
    }
    harness.run_steps(60);
    let after = scene(&harness).camera.view_unit();
    assert!(after < 0.8 * before, "{before} became {after}");
    assert_eq!(undo_all(&mut harness), 1);
}

#[test]
fn a_run_of_notches_is_one_step_where_frames_take_long_too() {
    let mut harness = window();
    let center = view_center(&harness);
    harness.event(Event::PointerMoved(center));
    harness.step();
    let before = scene(&harness).camera.view_unit();
    let mut now_secs = 10.0;
    for frame in 0..12 {
        now_secs += 0.7;
        let input = harness.input_mut();
        input.time = Some(now_secs);
        if frame < 8 {
            input.events.push(wheel(60.0));
        }
        harness.step();
    }
    assert!(scene(&harness).camera.view_unit() < 0.5 * before);
    harness.input_mut().time = None;
    assert_eq!(undo_all(&mut harness), 1);
}

#[test]
fn two_fingers_zoom() {
    let mut harness = window();
    let center = view_center(&harness);
    let before = scene(&harness).camera.view_unit();
    let touch = |id: u64, phase, x: f32| Event::Touch {
        device_id: TouchDeviceId(1),
        id: TouchId(id),
        phase,
        pos: center + vec2(x, 0.0),
        force: None,
    };
    harness.event(touch(1, TouchPhase::Start, -40.0));
    pointer(&harness, center - vec2(40.0, 0.0), PointerButton::Primary, true, Modifiers::NONE);
    harness.event(touch(2, TouchPhase::Start, 40.0));
    for i in 1..=10 {
        harness.event(touch(1, TouchPhase::Move, -40.0 - 8.0 * i as f32));
        harness.event(touch(2, TouchPhase::Move, 40.0 + 8.0 * i as f32));
    }
    harness.event(touch(1, TouchPhase::End, -120.0));
    pointer(&harness, center - vec2(120.0, 0.0), PointerButton::Primary, false, Modifiers::NONE);
    harness.event(touch(2, TouchPhase::End, 120.0));
    harness.run();
    let camera = &scene(&harness).camera;
    assert!(camera.view_unit() < 0.6 * before, "{before} became {}", camera.view_unit());
    assert_eq!(camera.orientation, Scene::default().camera.orientation, "a pinch does not orbit");
    assert_eq!(undo_all(&mut harness), 1);
}

#[test]
fn flight_keys_go_by_their_place_on_the_keyboard() {
    let mut harness = window();
    harness.key_press(Key::F);
    harness.run();
    let start = scene(&harness).camera.clone();
    // On AZERTY the key at W's place prints Z.
    let key = |pressed| Event::Key {
        key: Key::Z,
        physical_key: Some(Key::W),
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    harness.event(key(true));
    harness.run_steps(30);
    assert!(harness.state().interface.is_moving());
    harness.event(key(false));
    harness.run_steps(60);
    let moved = &scene(&harness).camera.position - &start.position;
    assert!(moved.dot(start.forward()) > 0.05, "flew {moved}");
    let rested = scene(&harness).camera.clone();
    harness.run_steps(30);
    assert_eq!(scene(&harness).camera, rested, "no motion on its own");
    assert_eq!(undo_all(&mut harness), 1, "a flight is one step");
}

#[test]
fn keys_do_nothing_while_text_is_typed() {
    let mut harness = window();
    press(&mut harness, "Power value");
    for key in [Key::H, Key::P, Key::Num3, Key::F, Key::L, Key::ArrowLeft] {
        harness.key_press(key);
    }
    harness.run();
    assert_eq!(*scene(&harness), Scene::default());
    assert!(harness.state().actions.is_empty());
    assert!(harness.state().interface.settings().panel_open);
}

#[test]
fn keys_do_what_the_table_says() {
    let mut harness = window();
    harness.key_press(Key::L);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    harness.run();
    assert_eq!(harness.state().actions, [Action::CopyLink, Action::LoadScene, Action::SaveScene]);
    harness.key_press(Key::P);
    harness.run();
    assert!(!harness.state().interface.settings().panel_open);
    press(&mut harness, "Show panel");
    assert!(harness.state().interface.settings().panel_open);
    harness.key_press(Key::Num4);
    harness.run();
    let expected = (mandelight::scene::presets::opening_scenes()[3].scene)();
    assert_eq!(scene(&harness).fractal, expected.fractal);
}

#[test]
fn home_returns_to_the_opening_view() {
    let mut harness = window();
    let home = scene(&harness).camera.clone();
    let center = view_center(&harness);
    drag(&mut harness, center, center + vec2(100.0, 20.0), 6);
    assert_ne!(scene(&harness).camera, home);
    harness.key_press(Key::H);
    harness.run_steps(200);
    assert!((&scene(&harness).camera.position - &home.position).length() < 1e-9);
}

#[test]
fn the_button_home_is_there_away_from_home() {
    let mut harness = window();
    harness.run();
    let home = scene(&harness).camera.clone();
    let is_shown = |harness: &egui_kittest::Harness<'_, Stage>| {
        harness.state().interface.rects().get("home").is_some()
    };
    assert!(!is_shown(&harness));
    let center = view_center(&harness);
    drag(&mut harness, center, center + vec2(100.0, 20.0), 6);
    assert!(is_shown(&harness));
    press(&mut harness, "Home");
    harness.run_steps(200);
    assert_eq!(scene(&harness).camera, home);
    assert!(!is_shown(&harness));
    assert_eq!(undo_all(&mut harness), 2);
}

#[test]
fn a_drag_goes_all_the_way_where_its_end_comes_in_the_same_frame() {
    let ends = [false, true].map(|at_once| {
        let mut harness = window();
        let center = view_center(&harness);
        harness.event(Event::PointerMoved(center));
        harness.step();
        pointer(&harness, center, PointerButton::Secondary, true, Modifiers::NONE);
        harness.step();
        harness.event(Event::PointerMoved(center + vec2(40.0, 10.0)));
        harness.step();
        let to = center + vec2(120.0, 60.0);
        let moved = Event::PointerMoved(to);
        let released = Event::PointerButton {
            pos: to,
            button: PointerButton::Secondary,
            pressed: false,
            modifiers: Modifiers::NONE,
        };
        // The harness gives each event of its own a frame.
        harness.input_mut().events.push(moved);
        if !at_once {
            harness.step();
        }
        harness.input_mut().events.push(released);
        harness.run();
        scene(&harness).camera.clone()
    });
    assert_eq!(ends[0], ends[1]);
    assert_ne!(ends[0], Scene::default().camera);
}

#[test]
fn the_light_ball_turns_the_light_as_one_step() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 1200.0]);
    let ball = harness.state().interface.rects().get("key light ball").expect("the ball is there");
    let before = scene(&harness).lights.environment[0].direction;
    drag(&mut harness, ball.center() + vec2(20.0, -10.0), ball.center() + vec2(-20.0, 15.0), 8);
    let light = &scene(&harness).lights.environment[0];
    assert_ne!(light.direction, before);
    let in_view =
        scene(&harness).camera.rotation().inverse() * glam::DVec3::from_array(light.direction);
    assert!(
        in_view.x < 0.0 && in_view.y < 0.0 && in_view.z > 0.0,
        "the light is where it was put: {in_view}"
    );
    assert_eq!(undo_all(&mut harness), 1);
}

#[test]
fn a_point_light_is_dragged_in_the_view() {
    let mut scene_with_point = Scene::default();
    let camera = &scene_with_point.camera;
    let position = camera.position.moved_by(camera.forward() * 1.5, 1e-9);
    scene_with_point
        .lights
        .point
        .push(mandelight::scene::PointLight { position, ..Default::default() });
    let mut harness = stage(scene_with_point.clone(), Settings::default(), [1280.0, 720.0]);
    let center = view_center(&harness);
    drag(&mut harness, center, center + vec2(90.0, 0.0), 6);
    assert_eq!(scene(&harness).camera, scene_with_point.camera, "the view stays");
    let moved =
        &scene(&harness).lights.point[0].position - &scene_with_point.lights.point[0].position;
    let right = scene_with_point.camera.rotation() * glam::DVec3::X;
    let height = harness.state().interface.rects().get("view").expect("the view is there").height();
    let expected = 90.0 * 2.0 * scene_with_point.camera.half_height(1.0) * 1.5 / f64::from(height);
    assert!((moved - right * expected).length() < 0.01 * expected, "{moved} for {expected}");
    assert_eq!(undo_all(&mut harness), 1);
}

#[test]
fn the_bailout_follows_the_power_into_its_range() {
    let mut harness = stage(Scene::default(), unfolded(), [1280.0, 4000.0]);
    slider(&harness, "Power").set_value_accesskit(2.0);
    harness.run();
    slider(&harness, "Bailout").set_value_accesskit(param::BAILOUT.max);
    harness.run();
    slider(&harness, "Power").set_value_accesskit(16.0);
    harness.run();
    assert_eq!(scene(&harness).validate(), Ok(()));
}

/// A finger that goes down, along, and up again.
fn swipe(harness: &mut egui_kittest::Harness<'_, Stage>, from: Pos2, to: Pos2) {
    let touch = |phase, pos| Event::Touch {
        device_id: TouchDeviceId(1),
        id: TouchId(7),
        phase,
        pos,
        force: None,
    };
    harness.event(touch(TouchPhase::Start, from));
    harness.event(Event::PointerMoved(from));
    pointer(harness, from, PointerButton::Primary, true, Modifiers::NONE);
    for i in 1..=12 {
        let at = from + (to - from) * (i as f32 / 12.0);
        harness.event(touch(TouchPhase::Move, at));
        harness.event(Event::PointerMoved(at));
    }
    harness.event(touch(TouchPhase::End, to));
    pointer(harness, to, PointerButton::Primary, false, Modifiers::NONE);
    harness.event(Event::PointerGone);
    harness.run_steps(90);
}

#[test]
fn a_finger_scrolls_across_a_rail_and_drags_its_handle() {
    let settings = Settings { sheet: SheetHeight::Half, ..unfolded() };
    let mut harness = stage(Scene::default(), settings, [390.0, 844.0]);
    let rail = |harness: &egui_kittest::Harness<'_, Stage>| {
        harness.state().interface.rects().get("power").expect("the power row is there")
    };
    // A first touch tells the interface that there are fingers.
    let center = view_center(&harness);
    swipe(&mut harness, center, center + vec2(40.0, 0.0));
    undo_all(&mut harness);
    let before = rail(&harness);
    let end = before.right_center() - vec2(90.0, 0.0);
    swipe(&mut harness, end, end - vec2(0.0, 60.0));
    assert_eq!(
        scene(&harness).fractal.number("power").unwrap(),
        mandelbulb::POWER.default,
        "scrolling changes nothing"
    );
    let after = rail(&harness);
    assert!(after.top() < before.top() - 20.0, "the panel scrolled from {before:?} to {after:?}");
    let handle = slider(&harness, "Power").rect();
    let part = (mandelbulb::POWER.default - mandelbulb::POWER.min)
        / (mandelbulb::POWER.max - mandelbulb::POWER.min);
    let handle = handle.left_center() + vec2(handle.width() * part as f32, 0.0);
    swipe(&mut harness, handle, handle + vec2(40.0, 0.0));
    assert!(
        scene(&harness).fractal.number("power").unwrap() > mandelbulb::POWER.default + 1.0,
        "the handle follows"
    );
}

/// The point that is clicked comes closer and to the middle, in one step, and the sky is no target.
#[test]
fn a_double_click_flies_to_the_point() {
    let mut harness = window();
    let center = view_center(&harness);
    let double_click = |harness: &mut egui_kittest::Harness<'_, Stage>, at: Pos2| {
        harness.event(Event::PointerMoved(at));
        for _ in 0..2 {
            pointer(harness, at, PointerButton::Primary, true, Modifiers::NONE);
            pointer(harness, at, PointerButton::Primary, false, Modifiers::NONE);
        }
        harness.run_steps(120);
    };
    let before = scene(&harness).camera.clone();
    double_click(&mut harness, center + vec2(60.0, -40.0));
    let after = scene(&harness).camera.clone();
    let ratio = after.view_unit() / before.view_unit();
    assert!((0.2..0.5).contains(&ratio), "the view unit changes by {ratio}");
    let shift = before.rotation().inverse() * (after.pivot.to_dvec3() - before.pivot.to_dvec3());
    assert!(shift.x > 0.05 && shift.y > 0.05, "the pivot is right and up of the old: {shift}");
    let toward = (after.pivot.to_dvec3() - after.position.to_dvec3()).normalize();
    assert!(toward.dot(after.forward()) > 0.999_999, "the point is in the middle");
    assert_eq!(undo_all(&mut harness), 1);

    let corner = harness.state().interface.rects().get("view").unwrap().left_top();
    double_click(&mut harness, corner + vec2(8.0, 60.0));
    assert_eq!(scene(&harness).camera, before);
}

/// Two hints stand on the picture at a first visit, and each goes once it was followed, for good.
#[test]
fn hints_go_when_they_are_followed() {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
    harness.run();
    let center = view_center(&harness);
    assert!(harness.query_by_label_contains("Drag to turn").is_some());
    drag(&mut harness, center, center + vec2(60.0, 10.0), 4);
    assert!(harness.query_by_label_contains("Drag to turn").is_none());
    assert!(harness.query_by_label("Scroll to come closer").is_some());
    harness.event(egui::Event::PointerMoved(center));
    harness.event(wheel(100.0));
    harness.run();
    assert!(harness.state().interface.rects().get("hint").is_none());
    let settings = harness.state().interface.settings().clone();
    assert!(settings.hints.has_turned && settings.hints.has_zoomed);
    let mut harness = stage(Scene::default(), settings, [1280.0, 720.0]);
    harness.run();
    assert!(harness.state().interface.rects().get("hint").is_none());
}

/// While C is held, the view before the last change is drawn, and nothing changes.
#[test]
fn holding_a_key_shows_the_view_before_the_last_change() {
    let mut harness = window();
    let start = scene(&harness).clone();
    assert!(harness.query_by_label_contains(NO_EARLIER_VIEW).is_none());
    harness.key_press(Key::C);
    harness.run_steps(3);
    harness.get_by_label_contains(NO_EARLIER_VIEW);
    let center = view_center(&harness);
    drag(&mut harness, center, center + vec2(80.0, 20.0), 4);
    let turned = scene(&harness).clone();
    let shown = |harness: &egui_kittest::Harness<'_, Stage>| {
        harness.state().interface.shown_scene().clone()
    };
    assert_eq!(shown(&harness), turned);
    harness.key_down(Key::C);
    harness.run_steps(3);
    assert_eq!((shown(&harness), scene(&harness).clone()), (start.clone(), turned.clone()));
    assert!(harness.state().interface.rects().get("comparing").is_some());
    harness.key_up(Key::C);
    harness.run_steps(3);
    assert_eq!(shown(&harness), turned);
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), start);
}
