//! The cards of scenes and dives: their pictures, places, marks and keys.

use std::collections::HashSet;

use egui::{
    Key, Rect, Shape, TextureId,
    accesskit::{Role, Toggled},
    vec2,
};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    scene::{
        Scene,
        presets::{self, Preset},
    },
    ui::{Settings, thumbnail},
};

use crate::stage::*;

/// Desktop windows, and a phone's.
const WINDOWS: [[f32; 2]; 3] = [[1440.0, 900.0], [1280.0, 720.0], [390.0, 844.0]];

/// The lists: the heading's button and the presets.
fn lists() -> [(&'static str, &'static [Preset]); 5] {
    presets::lists().map(|list| (list.name, list.presets))
}

fn opened(size: [f32; 2]) -> Harness<'static, Stage> {
    stage(presets::opening(), Settings::default(), size)
}

/// Rectangles with a picture.
fn pictures(harness: &Harness<'_, Stage>) -> Vec<(Rect, TextureId)> {
    let shapes = harness.output().shapes.iter();
    let rects = shapes.filter_map(|clipped| match &clipped.shape {
        Shape::Rect(shape) => Some((shape.rect, shape.brush.as_ref()?.fill_texture_id)),
        _ => None,
    });
    rects.collect()
}

/// Names of the cards that are marked as chosen.
fn chosen(harness: &Harness<'_, Stage>) -> Vec<&'static str> {
    let is_chosen = |name: &str| {
        let cards = harness.query_all_by_role_and_label(Role::Button, name);
        cards.into_iter().any(|card| card.accesskit_node().toggled() == Some(Toggled::True))
    };
    presets::all().map(|preset| preset.name).filter(|name| is_chosen(name)).collect()
}

#[test]
fn each_card_shows_a_picture_of_its_own() {
    let mut harness = opened([1280.0, 4000.0]);
    assert!(pictures(&harness).is_empty(), "nothing decodes pictures yet");
    egui_extras::install_image_loaders(&harness.ctx);
    for (heading, presets) in lists() {
        press(&mut harness, heading);
        let found = pictures(&harness);
        assert_eq!(found.len(), presets.len(), "{heading}");
        let textures: HashSet<TextureId> = found.iter().map(|(_, texture)| *texture).collect();
        assert_eq!(textures.len(), presets.len(), "{heading}: each its own");
        for preset in presets {
            let card = button(&harness, preset.name).rect();
            let has_picture = |(rect, _): &(Rect, TextureId)| {
                (rect.min - card.min).length() < 1.5 && (rect.max - card.max).length() < 1.5
            };
            assert!(found.iter().any(has_picture), "{} at {card:?}: {found:?}", preset.name);
        }
    }
}

#[test]
fn cards_fit_and_do_not_overlap() {
    for size in WINDOWS {
        let mut harness = opened(size);
        let panel = harness.state().interface.rects().get("panel").expect("the panel");
        // A sheet has a row of large cards that scrolls sideways; a panel has rows of them.
        let is_sheet = size[0] < size[1] && size[0] < 700.0;
        let columns = if is_sheet { usize::MAX } else { 2 };
        for (heading, presets) in lists() {
            press(&mut harness, heading);
            let cards: Vec<Rect> =
                presets.iter().map(|preset| button(&harness, preset.name).rect()).collect();
            for (i, card) in cards.iter().enumerate() {
                let is_within = card.left() >= panel.left() && card.right() <= panel.right();
                assert!(is_sheet || is_within, "{size:?}");
                assert!(!is_sheet || card.height() >= 90.0, "{card:?} is not large");
                assert!(card.height() >= 44.0, "{card:?} is too small for a finger");
                let aspect = thumbnail::SIZE_PX[0] as f32 / thumbnail::SIZE_PX[1] as f32;
                assert!((card.aspect_ratio() / aspect - 1.0).abs() < 0.02, "{card:?}");
                for other in &cards[..i] {
                    assert!(!card.shrink(1.0).intersects(*other), "{card:?} and {other:?}");
                }
                assert_eq!(card.top() == cards[0].top(), i < columns, "{size:?}: card {i}");
            }
        }
    }
}

#[test]
fn the_card_of_the_scene_in_view_is_marked() {
    let mut harness = without_motion(opened([1280.0, 4000.0]));
    assert_eq!(chosen(&harness), [presets::opening_scenes()[0].name]);
    for (heading, presets) in lists() {
        press(&mut harness, heading);
        for preset in presets {
            press(&mut harness, preset.name);
            assert_eq!(chosen(&harness), [preset.name]);
        }
    }
    press(&mut harness, "Scenes");
    press(&mut harness, presets::opening_scenes()[0].name);
    // Another power is another scene, until it is undone.
    slider(&harness, "Power").set_value_accesskit(5.0);
    harness.run();
    assert!(chosen(&harness).is_empty());
    undo_all(&mut harness);
    assert_eq!(chosen(&harness), [presets::opening_scenes()[0].name]);
    let mut other = scene(&harness).clone();
    other.quality.samples += 1;
    harness.state_mut().interface.replace_project(other);
    harness.run();
    assert_eq!(chosen(&harness), [presets::opening_scenes()[0].name], "quality is the user's");
    harness.state_mut().interface.replace_project(Scene::default());
    harness.run();
    assert!(chosen(&harness).is_empty());
}

#[test]
fn a_card_opens_by_keyboard_and_shows_that_it_has_the_focus() {
    let mut harness = opened([1280.0, 720.0]);
    let preset = presets::opening_scenes()[2];
    let outlines = |harness: &Harness<'_, Stage>| {
        let card = button(harness, preset.name).rect();
        let shapes = harness.output().shapes.iter();
        let strokes = shapes.filter_map(|clipped| match &clipped.shape {
            Shape::Rect(shape) if shape.rect == card => Some(shape.stroke),
            _ => None,
        });
        strokes.collect::<Vec<_>>()
    };
    let before = outlines(&harness);
    button(&harness, preset.name).focus();
    harness.run();
    assert_ne!(outlines(&harness), before);
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(scene(&harness).fractal, (preset.scene)().fractal);
    assert_eq!(chosen(&harness), [preset.name]);
}

#[test]
fn a_focused_card_scrolls_into_the_window() {
    let mut harness = opened([1280.0, 400.0]);
    let last = presets::opening_scenes().last().expect("a scene").name;
    let panel = harness.state().interface.rects().get("panel").expect("the panel");
    assert!(!panel.expand2(vec2(2.0, 0.0)).contains_rect(button(&harness, last).rect()));
    button(&harness, last).focus();
    harness.run();
    assert!(panel.expand2(vec2(2.0, 0.0)).contains_rect(button(&harness, last).rect()));
}

/// A scene opens by a flight: from the view of the same set, otherwise from the whole of the new one.
#[test]
fn a_scene_opens_by_a_flight_that_is_one_step() {
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 4000.0]);
    harness.run();
    let (start, dive) = (scene(&harness).clone(), presets::dives()[0]);
    for (heading, preset) in [("Dives", dive), ("Formulas", presets::formulas()[3])] {
        button(&harness, heading).click();
        harness.run_steps(3);
        button(&harness, preset.name).click();
        let target = (preset.scene)().camera;
        let mut distances = Vec::new();
        for _ in 0..600 {
            harness.step();
            distances.push(scene(&harness).camera.view_unit());
        }
        let first = distances[4];
        assert!(first > 1.2 * target.view_unit(), "{}: {first}", preset.name);
        assert_eq!(scene(&harness).camera, target, "{}", preset.name);
        harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        harness.run_steps(3);
        assert_eq!(*scene(&harness), start, "{}: one step", preset.name);
    }
}

#[test]
fn with_reduced_motion_a_scene_is_there_at_once() {
    let mut harness = without_motion(opened([1280.0, 4000.0]));
    press(&mut harness, "Dives");
    button(&harness, presets::dives()[0].name).click();
    harness.run_steps(3);
    assert_eq!(scene(&harness).camera, (presets::dives()[0].scene)().camera);
}

#[test]
fn the_lists_have_forty_scenes_with_pictures() {
    let with_picture = presets::all().filter(|preset| thumbnail::jpeg(preset).is_some());
    let names: HashSet<&str> = with_picture.map(|preset| preset.name).collect();
    assert!(names.len() >= 40, "{}", names.len());
    assert_eq!(names.len(), presets::all().count(), "each has a name and a picture of its own");
}
