//! The finder: by keyboard to every control.

use std::collections::{BTreeMap, BTreeSet};

use egui::{Key, Modifiers, accesskit::Role};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    scene::{IndirectKind, Project, Scene, looks, param, path, presets},
    ui::{
        Settings, SheetHeight,
        accessibility::{Request, ScreenReader},
        section_title_of, theme,
    },
};

use crate::stage::*;

fn find(harness: &mut Harness<'_, Stage>, text: &str) {
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

/// The names of the results.
fn results(harness: &Harness<'_, Stage>) -> Vec<String> {
    let window = harness.state().interface.rects().get("find window").expect("the window");
    let nodes = harness.root().children_recursive();
    let rows = nodes.filter(|node| {
        let node_role = node.accesskit_node().role();
        node_role == Role::Button && window.contains(node.rect().center())
    });
    rows.filter_map(|node| node.accesskit_node().label()).collect()
}

/// Types another text into the open finder.
fn retype(harness: &mut Harness<'_, Stage>, text: &str) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(2);
}

/// The names of controls in the panel and in the timeline.
fn names_of_controls(harness: &Harness<'_, Stage>) -> BTreeSet<String> {
    let rects = harness.state().interface.rects();
    let areas = ["panel", "timeline"].map(|name| rects.get(name).expect(name));
    let nodes = harness.root().children_recursive().filter(|node| {
        let is_in = |area: &egui::Rect| area.contains(node.rect().center());
        let node = node.accesskit_node();
        let is_control =
            egui::accessibility::is_input(node.role()) && node.role() != Role::Splitter;
        is_control && node.bounding_box().is_some() && areas.iter().any(is_in)
    });
    let names = nodes.filter_map(|node| node.accesskit_node().label());
    // The heading of all sections, each of which is found.
    let names = names.filter(|name| name != "More");
    names.map(|name| name.strip_suffix(" value").unwrap_or(&name).to_owned()).collect()
}

/// A control that is new in the panel or the timeline is found without a line in the finder.
#[test]
fn every_control_of_the_panel_and_the_timeline_is_found() {
    let mut project = Project::from(Scene::default());
    let key = |time_secs| path::Key {
        time_secs,
        easing: path::Easing::Smooth,
        scene: Scene::default().into(),
    };
    project.path.keys = vec![key(0.0), key(3.0)];
    let settings = Settings { timeline_open: true, ..unfolded() };
    let mut harness = without_motion(stage(project.clone(), settings, [1280.0, 6000.0]));
    harness.get_by_label("Key 2 at 3.00 s").click();
    harness.run();
    let names = names_of_controls(&harness);
    assert!(names.len() > 200, "{}", names.len());

    let mut harness = without_motion(stage(project, Settings::default(), [1280.0, 720.0]));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run();
    let is_found = |harness: &mut Harness<'_, Stage>, name: &str| {
        let name = name.strip_prefix("Look: ").unwrap_or(name);
        retype(harness, name);
        results(harness).iter().any(|result| result == name)
    };
    let missing: Vec<&String> = names.iter().filter(|name| !is_found(&mut harness, name)).collect();
    assert!(missing.is_empty(), "{} of {}: {missing:#?}", missing.len(), names.len());
}

#[test]
fn words_of_a_control_s_options_and_help_find_it() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run();
    for (typed, name) in [
        ("jpeg", "File: JPEG"),
        ("exr", "File: EXR"),
        ("webp", "File: WebP"),
        ("16 bit", "Bits per channel: 16"),
        ("transparent", "Background: Transparent"),
        ("jpeg quality", "Quality"),
        ("webm", "Kind of file"),
        ("mp4", "Kind of file"),
        ("save video", "Save video"),
        ("frame rate", "Frame rate"),
        ("motion blur", "Motion blur"),
        ("open a gradient file", "Choose a gradient…"),
        ("edit the formula", "Edit the formula…"),
        ("reset fog", "Reset: Fog"),
        ("form julia", "Form: Julia"),
        ("before", "Before: show the view before the last change for two seconds (hold C)"),
    ] {
        retype(&mut harness, typed);
        let found = results(&harness);
        assert!(found.iter().any(|result| result == name), "{typed}: {found:?}");
    }
}

/// The control that has the keyboard.
fn focused(harness: &Harness<'_, Stage>) -> Option<(String, egui::Rect)> {
    let mut nodes = harness.root().children_recursive();
    let node = nodes.find(|node| node.accesskit_node().is_focused())?;
    Some((node.accesskit_node().label()?, node.rect()))
}

#[test]
fn a_choice_is_shown_with_the_keyboard() {
    for size in [[1280.0, 720.0], [390.0, 844.0]] {
        for has_motion in [false, true] {
            let mut harness = stage(Scene::default(), Settings::default(), size);
            harness.state_mut().reduced_motion = !has_motion;
            harness.run();
            for (typed, part, name) in [
                ("file jpeg", "panel", "File: JPEG"),
                ("turntable", "timeline", "Turntable"),
                ("reset fog", "panel", "Reset: Fog"),
            ] {
                find(&mut harness, typed);
                harness.run_steps(30);
                let (label, rect) = focused(&harness).expect("a control");
                assert_eq!(label, name, "in {size:?}");
                let area = harness.state().interface.rects().get(part).expect(part);
                assert!(area.expand(1.0).contains_rect(rect), "{name}: {rect:?} in {area:?}");
            }
        }
    }
}

#[test]
fn the_view_before_the_last_change_is_shown_for_two_seconds() {
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), [1280.0, 720.0]));
    let before = scene(&harness).clone();
    find(&mut harness, "before: show");
    harness.run_steps(3);
    harness.get_by_label_contains(NO_EARLIER_VIEW);
    slider(&harness, "Power").set_value_accesskit(5.0);
    harness.run();
    let after = scene(&harness).clone();
    find(&mut harness, "before: show");
    let shown = |harness: &Harness<'_, Stage>| harness.state().interface.shown_scene().clone();
    harness.run_steps(3);
    assert_eq!(shown(&harness), before);
    // Each frame asks for the next: the last is not left on the screen of an idle page.
    let mut frames = 0;
    while shown(&harness) == before {
        let delay = harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
        assert!(delay.as_secs_f64() <= 2.0, "no repaint is asked for: {delay:?}");
        harness.step();
        frames += 1;
        assert!(frames < 130, "the view before the last change stays");
    }
    assert_eq!(shown(&harness), after);
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

/// Two sections have a *Strength*: the chosen section's gets the keyboard.
#[test]
fn controls_of_one_name_are_told_apart_by_their_section() {
    for size in [[1280.0, 720.0], [390.0, 844.0]] {
        let mut settings = Settings { more_open: true, ..Settings::default() };
        settings.sections.set_open("indirect", true);
        let mut lit = Scene::default();
        lit.indirect.kind = IndirectKind::Uniform;
        for (typed, path) in [
            ("strength bloom", "bloom.strength"),
            ("radius bloom", "bloom.radius"),
            ("strength indirect", "indirect.strength"),
        ] {
            let mut harness = without_motion(stage(lit.clone(), settings.clone(), size));
            find(&mut harness, typed);
            harness.run_steps(30);
            let mut nodes = harness.root().children_recursive();
            let focused = nodes.find(|node| node.accesskit_node().is_focused());
            let focused = focused.unwrap_or_else(|| panic!("{typed}")).accesskit_node();
            assert_eq!(focused.author_id(), Some(path), "{typed} in {size:?}");
        }
    }
}

#[test]
fn keys_and_lights_that_the_project_lacks_are_not_listed() {
    let mut harness =
        without_motion(stage(presets::opening(), Settings::default(), [1280.0, 720.0]));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
    harness.run();
    for lacking in [
        "Key 1 at 0.00 s",
        "Key 2 at 1.00 s",
        "Point 1",
        "Only Point 1",
        "Remove plane 1",
        "Move step 1",
        "Repeats of step 1",
    ] {
        retype(&mut harness, lacking);
        let found = results(&harness);
        assert!(!found.iter().any(|name| name.contains(lacking)), "{lacking}: {found:?}");
    }
    for other in ["Add point light", "Light 1", "Add key"] {
        retype(&mut harness, other);
        let found = results(&harness);
        assert!(found.iter().any(|name| name == other), "{other}: {found:?}");
    }
}

#[test]
fn a_control_that_the_scene_lacks_is_answered_by_a_notice() {
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), [1280.0, 720.0]));
    let has_notice =
        |harness: &Harness<'_, Stage>| harness.state().interface.rects().get("notice").is_some();
    find(&mut harness, "eye separation");
    assert!(has_notice(&harness));
    assert!(harness.query_by_label("This scene has no such control.").is_some());
    press(&mut harness, "Dismiss");
    assert!(!has_notice(&harness), "the cross closes it");
    assert!(harness.state().actions.is_empty(), "{:?}", harness.state().actions);
    // A control that is there needs no notice.
    find(&mut harness, "specular");
    harness.run_steps(150);
    assert!(!has_notice(&harness));
}

/// Without a screen reader egui makes no tree, and with one few: the search asks for those that it needs.
#[test]
fn a_choice_is_found_where_trees_are_rare() {
    let input = |count: u32, event: Option<egui::Event>| egui::RawInput {
        time: Some(f64::from(count) / 60.0),
        screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 720.0))),
        events: event.into_iter().collect(),
        ..egui::RawInput::default()
    };
    let key = |key, modifiers| egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers,
    };
    for has_reader in [false, true] {
        let context = egui::Context::default();
        theme::install(&context);
        if has_reader {
            context.add_plugin(ScreenReader::new(|_| {}, 0.2));
        }
        let mut stage = Stage::new(Scene::default(), Settings::default(), [1280.0, 720.0]);
        let mut trees = Vec::new();
        for count in 1..200 {
            let event = match count {
                10 => Some(key(Key::K, Modifiers::COMMAND)),
                20 => Some(egui::Event::Text("reset fog".to_owned())),
                30 => Some(key(Key::Enter, Modifiers::NONE)),
                _ => None,
            };
            let mut output = context.run_ui(input(count, event), |ui| stage.show(ui));
            output.textures_delta.clear();
            trees.push(output.platform_output.accesskit_update.is_some());
        }
        // A frame with a tree knows the name of what has the keyboard.
        context.enable_accesskit();
        if has_reader {
            context.plugin::<ScreenReader>().lock().request("0", &Request::Focus);
        }
        let mut output = context.run_ui(input(200, None), |ui| stage.show(ui));
        output.textures_delta.clear();
        let tree = output.platform_output.accesskit_update.expect("a tree");
        let focused = tree.nodes.iter().find(|(id, _)| *id == tree.focus);
        let name = focused.and_then(|(_, node)| node.label());
        assert_eq!(name, Some("Reset: Fog"), "with a screen reader: {has_reader}");
        let late = trees[150..].iter().filter(|has_tree| **has_tree).count();
        let expected = if has_reader { 3..=5 } else { 0..=0 };
        assert!(expected.contains(&late), "{late} trees after the search");
    }
}

#[test]
fn the_next_key_opens_the_timeline() {
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), [1280.0, 720.0]));
    find(&mut harness, "go to the next key");
    assert!(harness.state().interface.settings().timeline_open);
}
