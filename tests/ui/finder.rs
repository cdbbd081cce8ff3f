//! The finder: by keyboard to every control.

use std::collections::BTreeMap;

use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use mandelight::{
    scene::{Scene, looks, param, presets},
    ui::{Settings, SheetHeight, section_title_of},
};

use crate::stage::*;

fn find(harness: &mut egui_kittest::Harness<'_, Stage>, text: &str) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run();
    harness.get_by_label("What to find").type_text(text);
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
}

#[test]
fn a_control_is_found_shown_and_focused() {
    for size in [[1280.0, 720.0], [390.0, 844.0]] {
        let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
        find(&mut harness, "specular");
        let settings = harness.state().interface.settings().clone();
        assert!(settings.more_open && settings.sheet == SheetHeight::Half);
        let focused = harness.root().children_recursive();
        let focused: Vec<String> = focused
            .filter(|node| node.accesskit_node().is_focused())
            .filter_map(|node| node.accesskit_node().author_id().map(str::to_owned))
            .collect();
        assert_eq!(focused, ["surface.specular"], "in {size:?}");
        let panel = harness.state().interface.rects().get("panel").expect("the panel");
        let slider = slider(&harness, "Specular").rect();
        assert!(panel.contains_rect(slider), "{slider:?} in {panel:?} of {size:?}");
    }
}

#[test]
fn scenes_and_commands_are_found_too() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    find(&mut harness, "sea urchin");
    assert_eq!(scene(&harness).fractal, (presets::opening_scenes()[3].scene)().fractal);
    find(&mut harness, "undo");
    assert_eq!(*scene(&harness), presets::opening());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run();
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("What to find").is_none(), "Escape closes it");
}

#[test]
fn a_look_is_found_and_applied_as_one_step() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    let look = looks::find("porcelain").expect("a look");
    find(&mut harness, "porcelain");
    assert_eq!(*scene(&harness), looks::applied(look, &presets::opening()));
    assert_ne!(*scene(&harness), presets::opening());
    assert_eq!(undo_all(&mut harness), 1);
}

/// The finder opens the section in which a control really is.
#[test]
fn the_sections_of_controls_are_theirs() {
    let params: BTreeMap<&str, &param::Param> =
        param::all().map(|param| (param.path, param)).collect();
    let closed = Settings { more_open: true, ..Settings::default() };
    let paths = |settings: Settings| {
        let mut harness = stage(Scene::default(), settings, [1280.0, 6000.0]);
        harness.run();
        let nodes = harness.root().children_recursive();
        let ids = nodes.filter_map(|node| node.accesskit_node().author_id().map(str::to_owned));
        ids.collect::<Vec<String>>()
    };
    let always = paths(closed.clone());
    let mut checked = 0;
    for title in params.values().filter_map(|param| section_title_of(param)) {
        let mut harness = stage(Scene::default(), closed.clone(), [1280.0, 6000.0]);
        harness.run();
        harness.get_by_label(title).click();
        harness.run();
        let settings = harness.state().interface.settings().clone();
        for path in paths(settings).iter().filter(|path| !always.contains(path)) {
            if let Some(param) = params.get(path.as_str()) {
                assert_eq!(section_title_of(param), Some(title), "{path}");
                checked += 1;
            }
        }
    }
    assert!(checked > 20, "{checked} controls");
}
