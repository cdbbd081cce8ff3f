//! Two states that are compared: each keeps its edits, and the change between them is a step.

use egui::{Key, Modifiers, PointerButton};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{scene::presets, ui::Settings};

use crate::stage::*;

fn set_power(harness: &mut Harness<'_, Stage>, power: f64) {
    slider(harness, "Power").set_value_accesskit(power);
    harness.run();
}

#[test]
fn two_states_are_compared_and_each_keeps_its_edits() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    let swap = |harness: &mut Harness<'_, Stage>| {
        harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
        harness.run();
    };
    let first = scene(&harness).clone();
    assert!(harness.query_by_label("State A").is_none());
    swap(&mut harness);
    harness.get_by_label("State A");
    assert_eq!(*scene(&harness), first, "setting a state aside changes nothing");

    set_power(&mut harness, 5.0);
    let second = scene(&harness).clone();
    assert_ne!(second, first);
    press(&mut harness, "State A");
    assert_eq!(*scene(&harness), first);
    swap(&mut harness);
    assert_eq!(*scene(&harness), second);
    // Going to A and back were two steps, the power was one.
    assert_eq!(undo_all(&mut harness), 3);
    assert_eq!(*scene(&harness), first);
}

#[test]
fn the_comparison_ends_and_what_is_in_view_stays() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
    harness.run();
    set_power(&mut harness, 3.0);
    let kept = scene(&harness).clone();
    press(&mut harness, "End the comparison");
    assert!(harness.query_by_label("State A").is_none());
    assert_eq!(*scene(&harness), kept);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
    harness.run();
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("State A").is_none());
    assert_eq!(*scene(&harness), kept);
}

/// Buttons do all that the keys do: they compare two states and show the view before the last change.
#[test]
fn buttons_compare_two_states_and_show_the_one_before() {
    for (size, has_touch) in [
        ([390.0, 844.0], true),
        ([844.0, 390.0], true),
        ([1280.0, 720.0], false),
        ([640.0, 420.0], false),
    ] {
        let mut harness = without_motion(stage(presets::opening(), Settings::default(), size));
        let first = scene(&harness).clone();
        if has_touch {
            touch(&mut harness);
        }
        if harness.query_by_label("Before").is_none() {
            press(&mut harness, "More tools");
        }
        let nothing_changed = harness.get_by_label("Before");
        assert!(nothing_changed.accesskit_node().is_disabled(), "{size:?}");
        let at = nothing_changed.rect().center();
        drag(&mut harness, at, at - egui::vec2(0.0, 60.0), 3);
        assert_eq!(
            *scene(&harness),
            first,
            "a drag from the disabled tool turns no picture, in {size:?}"
        );
        let notice = harness.state().interface.rects().get("notice");
        assert!(notice.is_some(), "a press on the disabled tool says nothing, in {size:?}");
        harness.get_by_label_contains(NO_EARLIER_VIEW);
        press_tool(&mut harness, "Compare");
        harness.get_by_label("B is in view: the copy of A. Edits change B.");
        press(&mut harness, "State A");
        harness.get_by_label("A is in view: the state you began with. Edits change A.");
        press(&mut harness, "End the comparison");

        let mut changed = first.clone();
        changed.tone.exposure = 3.0;
        harness.state_mut().interface.replace_project(changed);
        harness.run();
        if harness.query_by_label("Before").is_none() {
            press(&mut harness, "More tools");
        }
        assert_ne!(*harness.state().interface.shown_scene(), first);
        let at = harness.get_by_label("Before").rect().center();
        harness.event(egui::Event::PointerMoved(at));
        harness.step();
        pointer(&harness, at, PointerButton::Primary, true, Modifiers::NONE);
        harness.run_steps(3);
        assert_eq!(*harness.state().interface.shown_scene(), first, "held, in {size:?}");
        pointer(&harness, at, PointerButton::Primary, false, Modifiers::NONE);
        harness.run_steps(3);
        assert_ne!(*harness.state().interface.shown_scene(), first, "let go, in {size:?}");
        assert_ne!(*scene(&harness), first, "nothing was undone");

        // Keys and screen readers hold nothing: they see it for a while.
        let button = harness.get_by_label("Before");
        button.focus();
        harness.run_steps(2);
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(*harness.state().interface.shown_scene(), first, "by Enter, in {size:?}");
    }
}
