//! Motion on the screen: views are reached by flights, or at once where a person asks for little motion.

use egui::{Event, Key, Modifiers, PointerButton, vec2};
use egui_kittest::Harness;
use mandelight::{
    scene::{Camera, Scene, document, presets},
    ui::{Settings, thumbnail},
};

use crate::stage::*;

fn camera(harness: &Harness<'_, Stage>) -> Camera {
    scene(harness).camera.clone()
}

/// A stage whose view was turned and moved away.
fn away(reduced_motion: bool) -> Harness<'static, Stage> {
    let mut harness = stage(Scene::default(), Settings::default(), [1280.0, 720.0]);
    harness.state_mut().reduced_motion = reduced_motion;
    harness.run();
    let center = harness.state().interface.rects().get("view").expect("the view").center();
    drag(&mut harness, center, center + vec2(160.0, 40.0), 6);
    for _ in 0..3 {
        harness.key_press(Key::Minus);
    }
    harness.run_steps(60);
    harness
}

fn double_click(harness: &mut Harness<'_, Stage>) {
    let at = harness.state().interface.rects().get("view").expect("the view").center();
    harness.event(Event::PointerMoved(at));
    for _ in 0..2 {
        pointer(harness, at, PointerButton::Primary, true, Modifiers::NONE);
        pointer(harness, at, PointerButton::Primary, false, Modifiers::NONE);
    }
}

/// What begins a movement of the view.
type Begin = fn(&mut Harness<'_, Stage>);

#[test]
fn home_double_click_and_frame_all_fly_or_jump() {
    let moves: [(&str, Begin); 3] = [
        ("Home", |harness| harness.key_press(Key::H)),
        ("Frame all", |harness| harness.key_press(Key::A)),
        ("a double click", double_click),
    ];
    for (name, begin) in moves {
        for reduced_motion in [true, false] {
            let mut harness = away(reduced_motion);
            let before = camera(&harness);
            begin(&mut harness);
            harness.run_steps(4);
            let early = camera(&harness);
            harness.run_steps(300);
            let end = camera(&harness);
            assert_ne!(end, before, "{name} moves the view");
            assert_eq!(early == end, reduced_motion, "{name}, reduced motion: {reduced_motion}");
        }
    }
}

#[test]
fn widgets_change_at_once_with_reduced_motion() {
    for reduced_motion in [false, true, false] {
        let harness = away(reduced_motion);
        let secs = harness.ctx.global_style().animation_time;
        assert_eq!(secs == 0.0, reduced_motion, "{secs} seconds");
    }
    // A setting that changes during the visit.
    let mut harness = away(false);
    harness.state_mut().reduced_motion = true;
    harness.run();
    assert_eq!(harness.ctx.global_style().animation_time, 0.0);
}

#[test]
fn a_kept_view_is_reached_by_a_flight() {
    for reduced_motion in [false, true] {
        let start = presets::opening();
        let mut harness = stage(start.clone(), Settings::default(), [1280.0, 720.0]);
        harness.state_mut().reduced_motion = reduced_motion;
        harness.run();
        let kept = document::project_to_json_compact(harness.state().interface.project());
        let jpeg = thumbnail::jpeg(&presets::opening_scenes()[0]).expect("a picture");
        harness.state_mut().interface.keep_favourite(kept, jpeg.to_vec());
        press(&mut harness, "Mine");
        let center = harness.state().interface.rects().get("view").expect("the view").center();
        drag(&mut harness, center, center + vec2(200.0, 40.0), 6);
        harness.run_steps(60);
        let turned = camera(&harness);
        button(&harness, "View 1").click();
        harness.run_steps(6);
        let early = camera(&harness);
        let is_between = early != turned && early != start.camera;
        assert_eq!(is_between, !reduced_motion, "reduced motion: {reduced_motion}");
        harness.run_steps(600);
        assert_eq!(camera(&harness), start.camera);
        assert!(!harness.state().interface.is_moving());
    }
}
