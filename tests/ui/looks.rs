//! Looks: shown under the pointer and with the keyboard, kept by a click, and where their swatches are.

use egui::{
    Event, Key, Modifiers, PointerButton, Pos2, Rect, Shape, TouchDeviceId, TouchId, TouchPhase,
    accesskit::{Role, Toggled},
    pos2, vec2,
};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    scene::{
        Scene,
        looks::{self, LookList},
        presets,
    },
    ui::Settings,
};

use crate::stage::*;

fn opened() -> Harness<'static, Stage> {
    without_motion(stage(presets::opening(), Settings::default(), [1280.0, 2000.0]))
}

fn shown(harness: &Harness<'_, Stage>) -> Scene {
    harness.state().interface.shown_scene().clone()
}

/// The opening scene in the look called `id`.
fn looked(id: &str) -> Scene {
    looks::applied(looks::find(id).expect("a look"), &presets::opening())
}

fn can_undo(harness: &Harness<'_, Stage>) -> bool {
    harness.state().interface.editor().can_undo()
}

fn hover(harness: &mut Harness<'_, Stage>, at: Pos2) {
    harness.event(Event::PointerMoved(at));
    harness.run_steps(3);
}

fn hover_look(harness: &mut Harness<'_, Stage>, title: &str) {
    let at = button(harness, title).rect().center();
    hover(harness, at);
}

/// A point over the picture.
const VIEW: Pos2 = pos2(400.0, 600.0);

#[test]
fn a_look_is_shown_under_the_pointer_and_leaves_with_it() {
    let mut harness = opened();
    let start = presets::opening();
    for (title, id) in [("Look: Gold", "gold"), ("Look: Neon", "neon")] {
        hover_look(&mut harness, title);
        assert_eq!(shown(&harness), looked(id));
        assert!(harness.query_by_label_contains("Preview: ").is_some());
        assert_eq!(*scene(&harness), start, "the document stays");
        assert!(!can_undo(&harness));
    }
    hover(&mut harness, VIEW);
    assert_eq!(shown(&harness), start);
    assert!(harness.query_by_label_contains("Preview: ").is_none());
}

#[test]
fn a_click_keeps_the_look_as_one_step_and_another_changes_nothing() {
    let mut harness = opened();
    let start = presets::opening();
    hover_look(&mut harness, "Look: Jade");
    let at = button(&harness, "Look: Jade").rect().center();
    for _ in 0..2 {
        for pressed in [true, false] {
            pointer(&harness, at, PointerButton::Primary, pressed, Modifiers::NONE);
            harness.step();
            // No flash of the scene before.
            assert_eq!(shown(&harness), looked("jade"));
        }
        harness.run_steps(3);
        assert_eq!(*scene(&harness), looked("jade"));
    }
    let node = button(&harness, "Look: Jade");
    assert_eq!(node.accesskit_node().toggled(), Some(Toggled::True));
    // The pointer is still there, and the undone scene shows.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!((scene(&harness).clone(), shown(&harness)), (start.clone(), start.clone()));
    assert!(!can_undo(&harness), "one step");
    hover(&mut harness, VIEW);
    assert_eq!(shown(&harness), start);
    hover_look(&mut harness, "Look: Jade");
    assert_eq!(shown(&harness), looked("jade"), "after leaving, it is shown again");
}

#[test]
fn the_keyboard_shows_looks_and_keeps_one() {
    let mut harness = opened();
    let start = presets::opening();
    button(&harness, "Look: Ember").focus();
    harness.run_steps(3);
    assert_eq!((shown(&harness), scene(&harness).clone()), (looked("ember"), start.clone()));
    harness.key_press(Key::Tab);
    harness.run_steps(3);
    assert_eq!((shown(&harness), scene(&harness).clone()), (looked("neon"), start.clone()));
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!((shown(&harness), scene(&harness).clone()), (looked("neon"), looked("neon")));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!((shown(&harness), scene(&harness).clone()), (start.clone(), start));
    assert!(!can_undo(&harness));
}

#[test]
fn no_look_is_shown_during_a_gesture() {
    let mut harness = opened();
    let target = button(&harness, "Look: Gold").rect().center();
    hover(&mut harness, VIEW);
    pointer(&harness, VIEW, PointerButton::Primary, true, Modifiers::NONE);
    harness.step();
    for at in [VIEW + vec2(60.0, 0.0), target, target + vec2(2.0, 0.0)] {
        harness.event(Event::PointerMoved(at));
        harness.step();
        assert_eq!(shown(&harness), *scene(&harness));
    }
    pointer(&harness, target, PointerButton::Primary, false, Modifiers::NONE);
    harness.run();
    let turned = scene(&harness).clone();
    assert_ne!(turned.camera, presets::opening().camera);
    // Afterwards the pointer is over the swatch, and shows its look as soon as it moves there.
    assert!(shown(&harness) == turned);
    hover(&mut harness, target + vec2(3.0, 1.0));
    let gold = looks::find("gold").expect("a look");
    assert_eq!(shown(&harness), looks::applied(gold, &turned));
}

fn touch(harness: &Harness<'_, Stage>, phase: TouchPhase, pos: Pos2) {
    let (device_id, id) = (TouchDeviceId(1), TouchId(1));
    harness.event(Event::Touch { device_id, id, phase, pos, force: None });
}

#[test]
fn a_swatch_that_scrolls_under_the_pointer_shows_nothing() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    let swatch = button(&harness, "Look: Gold").rect().center();
    hover(&mut harness, swatch - vec2(0.0, 200.0));
    harness.event(wheel(-200.0));
    harness.run_steps(60);
    let moved = button(&harness, "Look: Gold").rect();
    assert!(moved.contains(swatch - vec2(0.0, 200.0)), "{moved:?}");
    assert!(shown(&harness) == presets::opening());
    hover(&mut harness, moved.center() + vec2(2.0, 0.0));
    assert!(shown(&harness) == looked("gold"));
}

#[test]
fn a_tap_keeps_a_look_that_no_finger_hovers() {
    let mut harness = opened();
    // From the first touch on, rows are as high as fingers need.
    touch(&harness, TouchPhase::Cancel, VIEW);
    harness.run();
    let at = button(&harness, "Look: Candy").rect().center();
    touch(&harness, TouchPhase::Start, at);
    harness.event(Event::PointerMoved(at));
    pointer(&harness, at, PointerButton::Primary, true, Modifiers::NONE);
    harness.step();
    assert!(shown(&harness) == presets::opening(), "a finger may be about to scroll");
    touch(&harness, TouchPhase::End, at);
    pointer(&harness, at, PointerButton::Primary, false, Modifiers::NONE);
    harness.event(Event::PointerGone);
    harness.run();
    assert!(shown(&harness) == looked("candy") && *scene(&harness) == looked("candy"));
}

#[test]
fn holding_c_shows_the_scene_before_the_last_change_over_a_look() {
    let mut harness = opened();
    press(&mut harness, "Look: Gold");
    hover_look(&mut harness, "Look: Ink");
    assert_eq!(shown(&harness), looked("ink"));
    harness.key_down(Key::C);
    harness.run_steps(3);
    assert_eq!(shown(&harness), presets::opening());
    harness.key_up(Key::C);
    harness.run_steps(3);
    assert_eq!(shown(&harness), looked("ink"));
}

fn titles(list: &'static LookList) -> impl Iterator<Item = String> {
    list.looks.iter().map(|look| format!("{}: {}", list.kind, look.name))
}

#[test]
fn every_swatch_is_a_click_and_a_step_and_parts_mix() {
    let mut harness = opened();
    let mut expected = presets::opening();
    let mut steps = 0;
    for list in looks::lists() {
        press(&mut harness, &format!("Looks: {}", list.name));
        for (look, title) in list.looks.iter().zip(titles(list)) {
            let before = expected.clone();
            looks::apply(look, &mut expected);
            steps += usize::from(expected != before);
            button(&harness, &title).click();
            harness.run_steps(3);
            assert_eq!(*scene(&harness), expected, "{title}");
        }
    }
    assert!(steps > 60, "{steps}");
    assert_eq!(undo_all(&mut harness), steps);
    assert_eq!(*scene(&harness), presets::opening());
}

#[test]
fn swatches_fit_and_are_painted() {
    for size in [[1280.0, 3000.0], [640.0, 420.0], [390.0, 844.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        let is_phone = size[0] < 700.0;
        if is_phone {
            touch(&harness, TouchPhase::Cancel, Pos2::ZERO);
            harness.run();
        }
        for list in looks::lists() {
            button(&harness, &format!("Looks: {}", list.name)).click_accesskit();
            harness.run();
            let panel = harness.state().interface.rects().get("panel").expect("the panel");
            let rects: Vec<Rect> =
                titles(list).map(|title| button(&harness, &title).rect()).collect();
            for (i, rect) in rects.iter().enumerate() {
                let is_sheet = size[0] < size[1] && is_phone;
                let is_within = rect.left() >= panel.left() && rect.right() <= panel.right();
                assert!(is_sheet || is_within, "{rect:?} in {size:?}");
                assert!(rect.width() >= 44.0, "{rect:?}");
                assert!(!is_phone || rect.height() >= 44.0, "{rect:?} is too small for a finger");
                assert!(rects[..i].iter().all(|other| !other.intersects(*rect)), "{size:?}");
            }
            let first = titles(list).next().expect("a look");
            button(&harness, &first).focus();
            harness.run_steps(3);
            let rect = button(&harness, &first).rect();
            let is_painting = |shape: &Shape| match shape {
                Shape::Mesh(mesh) => rect.expand(1.0).contains_rect(mesh.calc_bounds()),
                _ => false,
            };
            let shapes = &harness.output().shapes;
            assert!(shapes.iter().any(|clipped| is_painting(&clipped.shape)), "{}", list.name);
        }
    }
}

#[test]
fn a_medium_has_no_gradient_to_choose() {
    let jade = presets::traced().iter().find(|preset| preset.name == "Jade").expect("a preset");
    let mut harness = stage((jade.scene)(), Settings::default(), [1280.0, 2000.0]);
    press(&mut harness, "Looks: Colours");
    assert!(harness.query_by_role_and_label(Role::Button, "Colours: Ember").is_none());
    assert!(harness.query_by_label_contains("have no gradient").is_some());
}
