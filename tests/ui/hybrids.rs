//! The steps of a hybrid, made and changed in the panel.

use egui::{Key, Modifiers, PointerButton};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    formula::{self, Fractal, HybridSteps, hybrid, section::SectionPlane},
    scene::Scene,
};

use crate::stage::*;

/// The formulas of the steps, in order.
fn ids(harness: &Harness<'_, Stage>) -> Vec<&'static str> {
    let hybrid = scene(harness).fractal.hybrid();
    hybrid.map_or_else(Vec::new, |hybrid| hybrid.steps.iter().map(|s| s.formula().id()).collect())
}

fn with_steps(all: &[&str]) -> Harness<'static, Stage> {
    let step = |id: &&str| hybrid::step(hybrid::find_step(id).expect("a formula")).expect("a step");
    let steps = HybridSteps { steps: all.iter().map(step).collect(), loop_start: 0 };
    let fractal = hybrid::fractal(steps).expect("a hybrid");
    stage(Scene { fractal, ..Scene::default() }, unfolded(), [1280.0, 3000.0])
}

#[test]
fn a_formula_is_mixed_with_others_and_comes_back_with_its_values() {
    let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
    let mut before = Scene { fractal, ..Scene::default() };
    assert!(before.fractal.set("scale", -1.5));
    before.fractal.section_planes = vec![SectionPlane::default()];
    before.fractal.iterations = 17;
    let mut harness = stage(before.clone(), unfolded(), [1280.0, 3000.0]);
    press(&mut harness, "Mix with another formula");
    press(&mut harness, "Twist");
    assert_eq!(ids(&harness), ["mandelbox", "twist"]);
    assert_eq!(scene(&harness).validate(), Ok(()));
    press(&mut harness, "Add a step");
    press(&mut harness, "Box fold");
    assert_eq!(ids(&harness), ["mandelbox", "twist", "box_fold"]);
    press(&mut harness, "Remove step 2");
    press(&mut harness, "Remove step 2");
    assert_eq!(scene(&harness).fractal.formula(), before.fractal.formula());
    assert_eq!(scene(&harness).fractal.values(), before.fractal.values());
    assert_eq!(scene(&harness).fractal.section_planes, before.fractal.section_planes);
}

#[test]
fn the_loop_still_begins_with_the_same_step_after_a_removal() {
    let mut harness = with_steps(&["rotate", "mandelbox", "mandelbulb"]);
    slider(&harness, "Loop start").set_value_accesskit(1.0);
    harness.run();
    press(&mut harness, "Remove step 1");
    assert_eq!(ids(&harness), ["mandelbox", "mandelbulb"]);
    assert_eq!(scene(&harness).fractal.hybrid().expect("a hybrid").loop_start, 0);
}

#[test]
fn a_drag_ends_when_its_row_is_undone() {
    let mut harness = with_steps(&["rotate", "mandelbox"]);
    press(&mut harness, "Add a step");
    press(&mut harness, "Twist");
    let from = harness.get_by_label("Move step 3").rect().center();
    let to = harness.get_by_label("Move step 1").rect().center();
    harness.event(egui::Event::PointerMoved(from));
    harness.step();
    pointer(&harness, from, PointerButton::Primary, true, Modifiers::NONE);
    harness.step();
    harness.event(egui::Event::PointerMoved(to));
    harness.step();
    undo_all(&mut harness);
    assert_eq!(ids(&harness), ["rotate", "mandelbox"]);
    pointer(&harness, to, PointerButton::Primary, false, Modifiers::NONE);
    harness.run();
    assert_eq!(ids(&harness), ["rotate", "mandelbox"]);
    let (from, to) = (harness.get_by_label("Move step 2").rect().center(), to);
    drag(&mut harness, from, to, 6);
    assert_eq!(ids(&harness), ["mandelbox", "rotate"]);
}

#[test]
fn steps_move_by_dragging_and_by_keys() {
    let mut harness = with_steps(&["rotate", "mandelbox", "mandelbulb"]);
    let at = |harness: &Harness<'_, Stage>, place: usize| {
        harness.get_by_label(&format!("Move step {place}")).rect().center()
    };
    let (from, to) = (at(&harness, 1), at(&harness, 3));
    drag(&mut harness, from, to, 6);
    assert_eq!(ids(&harness), ["mandelbox", "mandelbulb", "rotate"]);
    harness.get_by_label("Move step 3").focus();
    harness.run();
    harness.key_press(Key::ArrowUp);
    harness.run();
    assert_eq!(ids(&harness), ["mandelbox", "rotate", "mandelbulb"]);
}

#[test]
fn each_step_has_controls_of_its_own_parameters() {
    let mut harness = with_steps(&["mandelbox", "mandelbox"]);
    press(&mut harness, "2 Mandelbox");
    slider(&harness, "Scale").set_value_accesskit(3.0);
    harness.run();
    let hybrid = scene(&harness).fractal.hybrid().expect("a hybrid");
    let scales: Vec<_> = hybrid.steps.iter().map(|step| step.values()[0].clone()).collect();
    assert_eq!(scales, [2.0.into(), 3.0.into()]);
    slider(&harness, "Loop start").set_value_accesskit(1.0);
    harness.run();
    assert_eq!(scene(&harness).fractal.hybrid().expect("a hybrid").loop_start, 1);
    assert!(harness.query_by_label("1 Mandelbox (once)").is_some());
}

#[test]
fn a_long_text_in_the_number_of_repeats_does_not_widen_the_panel() {
    let mut harness = with_steps(&["mandelbox", "twist"]);
    let panel = |harness: &Harness<'_, Stage>| harness.state().interface.rects().get("panel");
    let before = panel(&harness);
    harness.get_by_label("Repeats of step 2").focus();
    harness.run();
    harness.event(egui::Event::Paste("length(z) ".repeat(500)));
    for _ in 0..4 {
        harness.step();
    }
    assert!(before.is_some());
    assert_eq!(panel(&harness), before);
}
