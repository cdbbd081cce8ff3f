//! What the page says is in words that someone knows who has never rendered anything.

use std::collections::BTreeSet;

use egui::{Key, Modifiers, Rect};
use egui_kittest::{Harness, kittest::NodeT as _};
use mandelight::{
    formula::section::SectionPlane,
    render::report::Activity,
    scene::{EnvironmentLight, PointLight, RigKind, Scene, presets},
    ui::{Settings, SheetHeight, shortcuts},
};

use crate::stage::*;

/// Words of specialists, and short forms.
const BANNED_WORDS: [&str; 6] = ["Rig", "EV", "u", "Typed", "M", "S"];
const BANNED_PHRASES: [&str; 3] = ["Motion budget", "Fixed to", "Limit reach"];
/// These a person may meet who opens *More*.
const EXPERT_PHRASES: [&str; 2] = ["Normals", "Reinhard"];

/// The texts that the last frame painted with their middle in `area`.
fn texts_in(harness: &Harness<'_, Stage>, area: Rect) -> Vec<String> {
    painted_texts(harness)
        .filter(|text| area.contains(text.visual_bounding_rect().center()))
        .map(|text| text.galley.text().to_owned())
        .collect()
}

/// The texts that the last frame painted in the panel.
fn texts(harness: &Harness<'_, Stage>) -> Vec<String> {
    let panel = harness.state().interface.rects().get("panel").expect("the panel");
    texts_in(harness, panel)
}

/// All texts of the last frame that are no keys and no formula, and the hover texts of its controls without their keys.
fn texts_and_help(harness: &Harness<'_, Stage>) -> Vec<String> {
    let keys: Vec<&str> = shortcuts::SHORTCUTS
        .iter()
        .filter_map(|shortcut| shortcut.help)
        .chain(shortcuts::FLIGHT.iter().filter_map(|flight| flight.help))
        .map(|(keys, _)| keys)
        .collect();
    let texts = painted_texts(harness).map(|text| text.galley.text().to_owned());
    let texts = texts.filter(|text| !keys.contains(&text.as_str()) && !text.contains("step {"));
    let nodes = harness.root().children_recursive();
    let help = nodes.filter_map(|node| node.accesskit_node().description());
    // A hover text has the control's key: `Show variations (M)`.
    let help = help.map(|help| without_keys(&help, &keys));
    texts.chain(help).collect()
}

/// A hover text without shortcuts in parentheses.
fn without_keys(help: &str, keys: &[&str]) -> String {
    keys.iter().fold(help.to_owned(), |help, key| help.replace(&format!(" ({key})"), ""))
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

/// The status line, the timeline, windows and hover texts.
#[test]
fn nothing_around_the_panel_has_short_forms() {
    const NONE: Modifiers = Modifiers::NONE;
    const COMMAND: Modifiers = Modifiers::COMMAND;
    let mut count = 0;
    for (what, keys) in [
        ("the page", &[][..]),
        ("the timeline", &[(NONE, Key::T), (NONE, Key::K), (NONE, Key::K)]),
        ("help", &[(NONE, Key::F1)]),
        ("sharing", &[(NONE, Key::J)]),
        ("variations", &[(NONE, Key::M)]),
        ("the finder", &[(COMMAND, Key::K)]),
        ("a comparison", &[(Modifiers::SHIFT, Key::C)]),
        ("fly mode", &[(NONE, Key::F)]),
    ] {
        let mut harness =
            without_motion(stage(presets::opening(), Settings::default(), [1280.0, 1400.0]));
        for &(modifiers, key) in keys {
            harness.key_press_modifiers(modifiers, key);
            harness.run_steps(14);
        }
        let texts = texts_and_help(&harness);
        count += texts.len();
        // The keys of fly mode stand in its caption.
        let is_of_keys = |text: &String| what == "fly mode" && text.contains("Shift for faster");
        let texts: Vec<String> = texts.into_iter().filter(|text| !is_of_keys(text)).collect();
        let banned = banned(&texts, &BANNED_PHRASES);
        assert!(banned.is_empty(), "{what}: {banned:?}");
    }
    assert!(count > 500, "{count}");
    let status = status_texts();
    assert!(status.len() >= 4, "{status:?}");
    assert!(banned(&status, &BANNED_PHRASES).is_empty(), "{status:?}");
}

/// What the status line says at each activity.
fn status_texts() -> Vec<String> {
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 720.0]);
    let activities = [Activity::Idle, Activity::Moving, Activity::Refining];
    let said = activities.into_iter().flat_map(|activity| {
        harness.state_mut().report.activity = activity;
        harness.run();
        let line = harness.state().interface.rects().get("status").expect("the status line");
        texts_in(&harness, line)
    });
    said.collect()
}

#[test]
fn hover_texts_of_all_sections_have_no_short_forms() {
    let texts = texts_and_help(&workshop());
    assert!(texts.len() > 400, "{}", texts.len());
    let banned = banned(&texts, &BANNED_PHRASES);
    assert!(banned.is_empty(), "{banned:?}");
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
    let whole = painted_texts(&harness)
        .any(|text| text.galley.text() == "-10.0 stops" && !text.galley.elided);
    assert!(whole, "{:?}", texts(&harness));
}

#[test]
fn the_measure_knows_banned_words() {
    let texts = ["0.0 EV", "Size 1 u", "Rig", "S", "Reinhard on", "Under you", "Right"];
    let texts = texts.map(str::to_owned);
    assert_eq!(banned(&texts, &EXPERT_PHRASES), texts[..5]);
}

/// Names that the program itself gives are shown whole: in each section, and on the cards of narrow and low windows.
#[test]
fn no_name_is_cut_off() {
    let sizes = [[1280.0, 6000.0], [360.0, 7000.0], [390.0, 844.0], [844.0, 390.0], [640.0, 420.0]];
    let heights = [SheetHeight::Low, SheetHeight::Tall];
    let cases = sizes.into_iter().flat_map(|size| heights.map(|sheet| (size, sheet)));
    let mut cut = BTreeSet::new();
    for (size, sheet) in cases {
        for scene in [presets::opening(), with_all_parts()] {
            for has_touch in [false, true] {
                let settings = Settings { sheet, ..unfolded() };
                let mut harness = stage(scene.clone(), settings, size);
                if has_touch {
                    touch(&mut harness);
                }
                harness.run();
                let texts: Vec<_> = painted_texts(&harness).map(|text| &text.galley).collect();
                let is_unfolded =
                    size[1] > 5000.0 && (size[0] > 1000.0 || sheet == SheetHeight::Tall);
                let least = if is_unfolded { 200 } else { 15 };
                assert!(texts.len() > least, "{size:?}, {sheet:?}: {} texts", texts.len());
                let elided = texts.iter().filter(|text| text.elided);
                cut.extend(elided.map(|text| format!("{size:?}: {}", text.text())));
            }
        }
    }
    assert!(cut.is_empty(), "{cut:?}");
}

/// A scene with the optional parts of most sections: light paths, fog, a sky, lights, depth of field, section planes.
fn with_all_parts() -> Scene {
    let mut scene = Scene::default();
    scene.trace_paths();
    scene.integrator.firefly_limit = Some(10.0);
    (scene.fog.density, scene.fog.height) = (0.5, Some(1.0));
    scene.lights.rig.kind = RigKind::Sky;
    scene.lights.environment.push(EnvironmentLight::default());
    scene.lights.point.push(PointLight::default());
    scene.camera.lens.depth_of_field = true;
    scene.fractal.section_planes.push(SectionPlane::default());
    scene
}
