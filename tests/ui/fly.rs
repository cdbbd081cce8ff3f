//! Fly mode on touch screens: what fingers do, how the view says so, and the button that stops.

use egui::{Event, Key, Modifiers, PointerButton, Pos2, TouchDeviceId, TouchId, TouchPhase, vec2};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    scene::{Camera, Scene},
    ui::Settings,
};

use crate::stage::*;

/// A stage in fly mode whose screen is touched.
fn flying(size: [f32; 2]) -> Harness<'static, Stage> {
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
    touch(&mut harness);
    harness.key_press(Key::F);
    harness.run();
    harness
}

fn caption(harness: &Harness<'_, Stage>) -> Option<egui::Rect> {
    harness.state().interface.rects().get("fly keys")
}

#[test]
fn the_caption_speaks_of_what_the_screen_is_used_by() {
    for size in [[390.0, 844.0], [844.0, 390.0], [1280.0, 800.0]] {
        let harness = flying(size);
        harness.get_by_label_contains("Drag to look around, spread or pinch two fingers");
        for word in ["Shift for faster", "Esc to stop"] {
            assert!(harness.query_by_label_contains(word).is_none(), "{word} in {size:?}");
        }
    }
    // A narrow window on a desktop has no fingers.
    for size in [[1280.0, 720.0], [480.0, 720.0]] {
        let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
        harness.key_press(Key::F);
        harness.run();
        harness.get_by_label_contains("Esc to stop");
        assert!(harness.query_by_label("Stop flying").is_none(), "the key stops in {size:?}");
    }
}

#[test]
fn a_button_on_the_picture_stops_the_flight() {
    for size in [[390.0, 844.0], [844.0, 390.0], [1280.0, 800.0]] {
        let mut harness = flying(size);
        let rects = harness.state().interface.rects();
        let (view, tools) = (rects.get("view").expect("the view"), rects.get("surprise"));
        let stop = button(&harness, "Stop flying").rect();
        assert!(stop.width() >= 44.0 && stop.height() >= 44.0, "{stop:?} in {size:?}");
        assert!(view.contains_rect(stop), "{stop:?} in {view:?}");
        let caption_rect = caption(&harness).expect("the caption");
        assert!(view.contains_rect(caption_rect), "{caption_rect:?} in {view:?}");
        assert!(!caption_rect.intersects(tools.expect("tools")), "{caption_rect:?} in {size:?}");
        press(&mut harness, "Stop flying");
        assert_eq!(caption(&harness), None, "in {size:?}");
    }
}

/// Two fingers from 40 points beside the middle of the view, each moved in ten steps.
fn two_fingers(harness: &mut Harness<'_, Stage>, moved: [egui::Vec2; 2]) {
    let center = harness.state().interface.rects().get("view").expect("the view").center();
    let from = [center - vec2(40.0, 0.0), center + vec2(40.0, 0.0)];
    let touch = |index: usize, phase, pos: Pos2| Event::Touch {
        device_id: TouchDeviceId(1),
        id: TouchId(index as u64 + 1),
        phase,
        pos,
        force: None,
    };
    let primary = PointerButton::Primary;
    harness.event(touch(0, TouchPhase::Start, from[0]));
    pointer(harness, from[0], primary, true, Modifiers::NONE);
    harness.event(touch(1, TouchPhase::Start, from[1]));
    harness.step();
    for step in 1..=10 {
        for index in 0..2 {
            let at = from[index] + moved[index] * (step as f32 / 10.0);
            harness.event(touch(index, TouchPhase::Move, at));
        }
        harness.step();
    }
    for index in 0..2 {
        harness.event(touch(index, TouchPhase::End, from[index] + moved[index]));
    }
    pointer(harness, from[0] + moved[0], primary, false, Modifiers::NONE);
    harness.run();
}

#[test]
fn fingers_look_around_and_fly() {
    let camera = |harness: &Harness<'_, Stage>| scene(harness).camera.clone();
    let mut harness = flying([390.0, 844.0]);
    let begun = camera(&harness);
    let center = harness.state().interface.rects().get("view").expect("the view").center();
    drag(&mut harness, center, center + vec2(50.0, 20.0), 6);
    let looked = camera(&harness);
    assert_ne!(looked.orientation, begun.orientation, "a finger looks around");
    assert_eq!(looked.position, begun.position, "from the same place");

    let travel = |moved: [egui::Vec2; 2]| {
        let mut harness = flying([390.0, 844.0]);
        two_fingers(&mut harness, moved);
        let Camera { position, .. } = &camera(&harness);
        assert!(caption(&harness).is_some(), "fly mode goes on");
        begun.rotation().inverse() * (position - &begun.position)
    };
    let apart = travel([vec2(-80.0, 0.0), vec2(80.0, 0.0)]);
    assert!(-apart.z > 0.1, "two fingers apart fly forward: {apart}");
    let together = travel([vec2(25.0, 0.0), vec2(-25.0, 0.0)]);
    assert!(together.z > 0.1, "two fingers together fly back: {together}");
    let aside = travel([vec2(140.0, 0.0), vec2(140.0, 0.0)]);
    assert!(aside.x < -0.05 && aside.z.abs() < 0.3 * aside.x.abs(), "sideways: {aside}");
}
