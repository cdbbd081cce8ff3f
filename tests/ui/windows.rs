//! Windows over the picture close by their cross and by Escape.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use mandelight::{
    formula::{self, Fractal},
    scene::Scene,
    ui::Settings,
};

use crate::stage::*;

#[test]
fn the_cross_closes_each_window() {
    for (key, modifiers, window) in [
        (Key::F1, Modifiers::NONE, "help window"),
        (Key::J, Modifiers::NONE, "share window"),
        (Key::K, Modifiers::COMMAND, "find window"),
    ] {
        let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
        let is_open = |harness: &egui_kittest::Harness<'_, Stage>| {
            harness.state().interface.rects().get(window).is_some()
        };
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(4);
        assert!(is_open(&harness), "{window}");
        harness.get_by_label("Close window").click();
        harness.run_steps(8);
        assert!(!is_open(&harness), "{window}");
    }
}

#[test]
fn escape_closes_each_window() {
    const NONE: Modifiers = Modifiers::NONE;
    for (key, modifiers, what) in [
        (Key::F1, NONE, "help window"),
        (Key::J, NONE, "share window"),
        (Key::K, Modifiers::COMMAND, "find window"),
        (Key::M, NONE, "variations"),
        (Key::C, Modifiers::SHIFT, "compare"),
    ] {
        let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
        let is_open = |harness: &egui_kittest::Harness<'_, Stage>| match what {
            "variations" => harness.query_by_label("Surprise me").is_none(),
            window => harness.state().interface.rects().get(window).is_some(),
        };
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(4);
        assert!(is_open(&harness), "{what}");
        harness.key_press(Key::Escape);
        harness.run_steps(8);
        assert!(!is_open(&harness), "{what}");
    }
}

/// The text field of the formula takes the first Escape, which ends the typing.
#[test]
fn escape_closes_the_formula_window() {
    let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
    let scene = Scene { fractal, ..Scene::default() };
    let is_open = |harness: &egui_kittest::Harness<'_, Stage>| {
        harness.query_by_label("Formula text").is_some()
    };
    for types in [false, true] {
        let mut harness = stage(scene.clone(), unfolded(), [1280.0, 3000.0]);
        button(&harness, "Edit the formula…").click_accesskit();
        harness.run_steps(4);
        if types {
            harness.get_by_label("Formula text").focus();
            harness.run_steps(4);
            harness.key_press(Key::Escape);
            harness.run_steps(4);
            assert!(is_open(&harness), "the field takes the first");
        }
        harness.key_press(Key::Escape);
        harness.run_steps(8);
        assert!(!is_open(&harness), "typed: {types}");
    }
}
