//! Variations and surprises: chosen by a click, one undo step each.

use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::Queryable as _;
use mandelight::{
    scene::{Scene, presets},
    ui::{Settings, ViewTexture},
};

use crate::stage::*;

#[test]
fn a_variation_becomes_the_scene_by_a_click_and_locks_hold() {
    let start = presets::opening();
    let mut harness = stage(start.clone(), Settings::default(), [1280.0, 720.0]);
    harness.key_press(Key::M);
    harness.step();
    harness.step();
    assert_eq!(
        harness.state().interface.small_pictures().count(),
        0,
        "the scene's own is not made"
    );
    harness.run_steps(20);
    let small: Vec<_> = harness.state().interface.small_pictures().cloned().collect();
    assert_eq!(small.len(), 9);
    let is_start =
        |scene: &Scene| Scene { quality: start.quality.clone(), ..scene.clone() } == start;
    assert!(is_start(&small[0].scene), "the scene itself is drawn first");
    assert_eq!(small.iter().filter(|picture| is_start(&picture.scene)).count(), 1);
    // The view is kept at first.
    assert!(small.iter().all(|picture| picture.scene.camera == start.camera));
    harness.get_by_label("Variation 2").click();
    harness.run_steps(20);
    let chosen = scene(&harness).clone();
    assert_eq!(chosen.fractal, small[2].scene.fractal);
    assert_eq!(chosen.quality, start.quality);
    harness.get_by_label("Keep: Shape").click();
    harness.run_steps(20);
    let kept: Vec<_> = harness.state().interface.small_pictures().cloned().collect();
    assert!(kept.iter().all(|picture| picture.scene.fractal == chosen.fractal));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(20);
    assert_eq!(*scene(&harness), start, "one step");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(harness.state().interface.small_pictures().count(), 0);
}

#[test]
fn cells_without_a_picture_say_that_it_is_being_drawn() {
    let mut harness = stage(presets::opening(), Settings::default(), [390.0, 844.0]);
    harness.get_by_label("Mutate").click();
    harness.run_steps(20);
    assert_eq!(painted(&harness, "Drawing…").len(), 9);
    let first = harness.state().interface.small_pictures().next().expect("a variation").id;
    let picture = ViewTexture { texture: egui::TextureId::User(7), size_px: [96, 64] };
    harness.state_mut().small_pictures.by_id.insert(first, picture);
    harness.run_steps(2);
    let still_drawn = painted(&harness, "Drawing…");
    assert_eq!(still_drawn.len(), 8);
    // The first picture is the scene's, in the middle.
    let middle = harness.get_by_label("The scene itself").rect();
    assert!(still_drawn.iter().all(|text| !middle.contains(text.center())));
}

#[test]
fn the_variations_fit_a_phone() {
    for size in [[390.0, 844.0], [844.0, 390.0], [1280.0, 720.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        harness.get_by_label("Mutate").click();
        harness.run_steps(20);
        let rects = harness.state().interface.rects();
        let view = rects.get("view").expect("the view");
        for name in ["how different", "close variations"] {
            let rect = rects.get(name).unwrap_or(Rect::NOTHING);
            assert!(view.contains_rect(rect), "{name}: {rect:?} in {view:?}");
        }
        let [first, keep] =
            ["Variation 1", "Keep: Shape"].map(|label| harness.get_by_label(label).rect());
        let caption = painted(&harness, "How different")[0];
        let left = first.left().min(0.5 * (view.width() - 340.0));
        assert!((caption.left() - left).abs() < 2.0, "{caption:?} in {view:?}");
        assert!(keep.top() > first.bottom(), "{keep:?}");
    }
}

#[test]
fn a_surprise_is_another_scene_and_one_step() {
    let start = presets::opening();
    let mut harness = without_motion(stage(start.clone(), Settings::default(), [1280.0, 720.0]));
    harness.get_by_label("Surprise me").click();
    harness.run_steps(60);
    let surprise = scene(&harness).clone();
    assert_ne!(surprise, start);
    assert_eq!(surprise.validate(), Ok(()));
    assert_eq!(undo_all(&mut harness), 1);
    assert_eq!(*scene(&harness), start);
}
