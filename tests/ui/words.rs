//! What stands in the panel is in words that someone knows who has never rendered anything.

use egui::Shape;
use egui_kittest::Harness;
use mandelight::{scene::presets, ui::Settings};

use crate::stage::*;

/// Words of specialists, and short forms.
const BANNED_WORDS: [&str; 6] = ["Rig", "EV", "u", "Typed", "M", "S"];
const BANNED_PHRASES: [&str; 3] = ["Motion budget", "Fixed to", "Limit reach"];
/// These a person may meet who opens *More*.
const EXPERT_PHRASES: [&str; 2] = ["Normals", "Reinhard"];

/// The texts that the last frame painted in the panel.
fn texts(harness: &Harness<'_, Stage>) -> Vec<String> {
    let panel = harness.state().interface.rects().get("panel").expect("the panel");
    let texts = shapes(harness).into_iter().filter_map(|shape| match shape {
        Shape::Text(text) if panel.contains(text.visual_bounding_rect().center()) => {
            Some(text.galley.text().to_owned())
        }
        _ => None,
    });
    texts.collect()
}

/// The texts with a banned word, or with a phrase of `phrases`.
fn banned(texts: &[String], phrases: &[&str]) -> Vec<String> {
    let is_banned = |text: &&String| {
        let mut words = text.split(|c: char| !c.is_alphanumeric());
        let has_phrase = |phrase: &&str| text.to_lowercase().contains(&phrase.to_lowercase());
        words.any(|word| BANNED_WORDS.contains(&word)) || phrases.iter().any(has_phrase)
    };
    texts.iter().filter(is_banned).cloned().collect()
}

#[test]
fn the_simple_panel_has_no_words_of_specialists() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 3000.0]));
    let phrases: Vec<&str> = BANNED_PHRASES.into_iter().chain(EXPERT_PHRASES).collect();
    let mut count = 0;
    let mut look = |harness: &Harness<'_, Stage>| {
        let texts = texts(harness);
        count += texts.len();
        let banned = banned(&texts, &phrases);
        assert!(banned.is_empty(), "{banned:?}");
    };
    look(&harness);
    for list in presets::lists() {
        press(&mut harness, list.name);
        look(&harness);
    }
    for list in mandelight::scene::looks::lists() {
        press(&mut harness, &format!("Looks: {}", list.name));
        look(&harness);
    }
    press(&mut harness, "Mine");
    look(&harness);
    assert!(count > 200, "{count}");
}

#[test]
fn no_section_has_short_forms() {
    let mut harness = workshop();
    for control in ["Form: Julia", "Sky light: Sky", "Add point light", "Cut open"] {
        button(&harness, control).click_accesskit();
        harness.run();
    }
    let texts = texts(&harness);
    assert!(texts.len() > 200, "{}", texts.len());
    let banned = banned(&texts, &BANNED_PHRASES);
    assert!(banned.is_empty(), "{banned:?}");
}

#[test]
fn the_exposure_is_in_stops_and_has_room() {
    let mut scene = presets::opening();
    scene.tone.exposure = -10.0;
    let harness = stage(scene, Settings::default(), [1280.0, 3000.0]);
    let whole = shapes(&harness).into_iter().any(|shape| match shape {
        Shape::Text(text) => text.galley.text() == "-10.0 stops" && !text.galley.elided,
        _ => false,
    });
    assert!(whole, "{:?}", texts(&harness));
}

#[test]
fn the_measure_knows_banned_words() {
    let texts = ["0.0 EV", "Size 1 u", "Rig", "S", "Reinhard on", "Under you", "Right"];
    let texts = texts.map(str::to_owned);
    assert_eq!(banned(&texts, &EXPERT_PHRASES), texts[..5]);
}
