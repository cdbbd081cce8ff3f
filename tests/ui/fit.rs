//! Everything is where it can be reached, in every window.

use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use mandelight::{
    scene::{Scene, presets},
    ui::{Notice, Settings},
};

use crate::stage::*;

const WINDOWS: [[f32; 2]; 7] = [
    [640.0, 420.0],
    [360.0, 640.0],
    [390.0, 844.0],
    [844.0, 390.0],
    [699.0, 500.0],
    [1280.0, 720.0],
    [3840.0, 2160.0],
];

/// Widgets that stick out of the window sideways, or out of it below without being in the
/// scrolled part of the panel.
fn misfits(harness: &egui_kittest::Harness<'_, Stage>, window: Rect) -> Vec<String> {
    harness
        .root()
        .children_recursive()
        .filter(|node| egui::accessibility::is_input(node.accesskit_node().role()))
        .filter(|node| node.accesskit_node().bounding_box().is_some())
        // The scenes and looks of a sheet scroll sideways.
        .filter(|node| {
            let label = node.accesskit_node().label().unwrap_or_default();
            !presets::all().any(|preset| label == preset.name) && !label.starts_with("Look: ")
        })
        .filter(|node| {
            let rect = node.rect();
            rect.left() < window.left() - 0.5 || rect.right() > window.right() + 0.5
        })
        .map(|node| {
            format!(
                "{:?} {:?} {:?}",
                node.accesskit_node().role(),
                node.accesskit_node().label(),
                node.rect()
            )
        })
        .collect()
}

#[test]
fn nothing_is_cut_off_at_the_sides() {
    for size in WINDOWS {
        for settings in [Settings::default(), unfolded()] {
            let mut harness = stage(Scene::default(), settings, size);
            press_add_point(&mut harness);
            let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
            let misfits = misfits(&harness, window);
            assert!(misfits.is_empty(), "in {size:?}: {misfits:#?}");
        }
    }
}

fn press_add_point(harness: &mut egui_kittest::Harness<'_, Stage>) {
    if let Some(button) = harness.query_by_label("Add point light") {
        button.click_accesskit();
        harness.run();
    }
}

#[test]
fn the_parts_of_the_window_do_not_overlap_and_the_view_has_room() {
    for size in WINDOWS {
        let harness = stage(Scene::default(), Settings::default(), size);
        let rects = harness.state().interface.rects();
        let [view, panel, status] =
            ["view", "panel", "status"].map(|name| rects.get(name).expect(name));
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        assert!(window.expand(0.6).contains_rect(panel), "{panel:?} in {size:?}");
        for (a, b) in [(view, panel), (view, status), (panel, status)] {
            let both = a.intersect(b);
            assert!(both.width() < 0.6 || both.height() < 0.6, "{a:?} and {b:?} in {size:?}");
        }
        let part = view.area() / (size[0] * size[1]);
        assert!(part > 0.35, "the view has {part} of {size:?}");
        let size_px = harness.state().interface.view_size_px();
        assert_eq!(size_px, [view.width().round() as u32, view.height().round() as u32]);
    }
}

#[test]
fn the_picture_has_the_view_s_pixels_at_any_pixel_ratio() {
    for ratio in [0.75, 1.0, 1.5, 2.0, 2.625, 3.0] {
        let mut harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
        harness.set_pixels_per_point(ratio);
        harness.run();
        let view = harness.state().interface.rects().get("view").expect("the view is there");
        let [width, height] = harness.state().interface.view_size_px();
        assert!((view.width() * ratio - width as f32).abs() < 0.51, "width at {ratio}");
        assert!((view.height() * ratio - height as f32).abs() < 0.51, "height at {ratio}");
    }
}

/// The name stands whole beside the buttons, or not at all.
#[test]
fn the_heading_is_not_cut_off() {
    for size in WINDOWS.into_iter().chain([[640.0, 420.0], [320.0, 568.0]]) {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        harness.event(egui::Event::Touch {
            device_id: egui::TouchDeviceId(1),
            id: egui::TouchId(1),
            phase: egui::TouchPhase::Cancel,
            pos: egui::Pos2::ZERO,
            force: None,
        });
        harness.run();
        let undo = harness.state().interface.rects().get("undo").expect("the button is there");
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        assert!(window.contains_rect(undo), "{undo:?} in {size:?}");
        if let Some(name) = harness.query_by_label("Mandelight") {
            let name = name.rect();
            assert!(name.right() <= undo.left(), "{name:?} and {undo:?} in {size:?}");
            assert!(name.width() > 80.0, "{name:?} in {size:?}");
        }
    }
}

#[test]
fn a_phone_shows_more_picture_than_panel() {
    for (size, least) in [([390.0, 844.0], 0.65), ([844.0, 390.0], 0.55), ([640.0, 420.0], 0.5)] {
        let harness = stage(Scene::default(), Settings::default(), size);
        let view = harness.state().interface.rects().get("view").expect("the view is there");
        let part = view.area() / (size[0] * size[1]);
        assert!(part > least, "the view has {part} of {size:?}");
        let shorter = view.width().min(view.height());
        assert!(shorter > 300.0, "{view:?} in {size:?}");
    }
}

#[test]
fn the_sheet_follows_a_drag_of_its_heading_and_a_tap() {
    let mut harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
    let rect = |harness: &egui_kittest::Harness<'_, Stage>, name: &str| {
        harness.state().interface.rects().get(name).unwrap_or_else(|| panic!("no {name}"))
    };
    let low = rect(&harness, "panel").height();
    assert!(button(&harness, presets::opening_scenes()[0].name).rect().bottom() < 844.0);
    // The bar is in the middle of the heading's upper edge.
    let grip = |harness: &_| rect(harness, "sheet handle").center_top() + egui::vec2(0.0, 3.0);
    let from = grip(&harness);
    drag(&mut harness, from, from - egui::vec2(0.0, 280.0), 6);
    let half = rect(&harness, "panel").height();
    assert!((half - 464.0).abs() < 2.0, "{half}");
    let from = grip(&harness);
    drag(&mut harness, from, from + egui::vec2(0.0, 400.0), 6);
    assert!(!harness.state().interface.settings().panel_open, "a drag to the edge closes it");
    for height in [low, half, low] {
        let at = grip(&harness);
        drag(&mut harness, at, at, 1);
        let after = rect(&harness, "panel").height();
        assert!((after - height).abs() < 1.0, "{after} for {height}");
    }
}

#[test]
fn rows_are_finger_sized_in_narrow_windows() {
    let harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
    let rects = harness.state().interface.rects();
    for name in ["power", "first scene", "save picture"] {
        let height = rects.get(name).expect(name).height();
        assert!(height >= 43.9, "{name} is {height} points high");
    }
}

#[test]
fn messages_have_buttons_for_fingers() {
    let mut harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
    touch(&mut harness);
    harness.state_mut().notice = Some(Notice {
        text: "The scene stopped the graphics card".to_owned(),
        offer: Some("Open it"),
        ..Notice::default()
    });
    harness.run();
    for label in ["Open it", "Dismiss"] {
        let rect = harness.get_by_label(label).rect();
        assert!(rect.height() >= 43.9, "{label}: {rect:?}");
        assert!(rect.right() <= 390.0, "{label}: {rect:?}");
    }
}

#[test]
fn a_hidden_panel_leaves_the_window_to_the_picture() {
    for size in WINDOWS {
        let settings = Settings { panel_open: false, ..Settings::default() };
        let mut harness = stage(Scene::default(), settings, size);
        let view = harness.state().interface.rects().get("view").expect("the view is there");
        assert_eq!(view.width(), size[0]);
        assert!(view.height() >= size[1] - 80.0, "{view:?} of {size:?}");
        press(&mut harness, "Show panel");
        assert!(harness.state().interface.settings().panel_open);
    }
}

#[test]
fn a_long_notice_stays_in_the_window() {
    for size in WINDOWS {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        let text = "The file could not be read: ".to_owned()
            + &"lights.environment[2].intensity ".repeat(6);
        harness.state_mut().notice =
            Some(Notice { text: text.clone(), is_error: true, ..Notice::default() });
        harness.run();
        harness.get_by_role_and_label(egui::accesskit::Role::Alert, &text);
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        let dismiss = harness.get_by_label("Dismiss").rect();
        assert!(window.contains_rect(dismiss), "{dismiss:?} in {size:?}");
        press(&mut harness, "Dismiss");
        assert_eq!(harness.state().actions, [mandelight::ui::Action::DismissNotice]);
    }
}

#[test]
fn a_file_that_is_read_is_named_below_the_notice_and_can_be_cancelled() {
    for size in WINDOWS {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        let text = "Link copied.".to_owned();
        harness.state_mut().notice =
            Some(Notice { text: text.clone(), is_error: false, ..Notice::default() });
        harness.state_mut().reading = Some("garden.hdr".to_owned());
        harness.run();
        harness.get_by_role_and_label(egui::accesskit::Role::Status, "Reading garden.hdr…");
        let rects = harness.state().interface.rects();
        let [notice, reading] = ["notice", "reading"].map(|name| rects.get(name).expect(name));
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        assert!(window.contains_rect(reading), "{reading:?} in {size:?}");
        assert!(reading.top() > notice.bottom(), "{reading:?} and {notice:?} in {size:?}");
        press(&mut harness, "Cancel");
        assert_eq!(harness.state().actions, [mandelight::ui::Action::CancelReading]);
    }
}

/// The opening set spans most of a low view's height; hints leave it free.
#[test]
fn hints_in_low_views_leave_the_middle_free() {
    for size in [[844.0, 390.0], [640.0, 420.0], [1280.0, 720.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        harness.run();
        let rects = harness.state().interface.rects();
        let (view, hint) = (rects.get("view").expect("the view"), rects.get("hint"));
        let hint = hint.expect("a hint");
        let set = Rect::from_center_size(view.center(), egui::Vec2::splat(0.76 * view.height()));
        assert!(!hint.intersects(set), "{hint:?} covers the middle of {view:?}");
        assert!(view.contains_rect(hint), "{hint:?} in {view:?}");
    }
}

/// A hint does not look out from behind a window: it waits until the window is closed.
#[test]
fn hints_wait_while_a_window_is_open() {
    const COMMAND: Modifiers = Modifiers::COMMAND;
    for size in [[844.0, 390.0], [640.0, 420.0], [1280.0, 720.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        harness.run();
        let has_hint = |harness: &egui_kittest::Harness<'_, Stage>| {
            harness.state().interface.rects().get("hint").is_some()
        };
        let none = Modifiers::NONE;
        for (modifiers, key) in [(COMMAND, Key::K), (none, Key::F1), (none, Key::J), (none, Key::M)]
        {
            assert!(has_hint(&harness), "before {key:?} in {size:?}");
            harness.key_press_modifiers(modifiers, key);
            harness.run_steps(4);
            assert!(!has_hint(&harness), "{key:?} in {size:?}");
            harness.key_press(Key::Escape);
            harness.run_steps(4);
        }
        harness.state_mut().notice = Some(Notice { text: "A message".into(), ..Notice::default() });
        harness.run_steps(4);
        assert!(!has_hint(&harness), "with a message in {size:?}");
    }
}

#[test]
fn help_begins_with_what_the_screen_is_used_by() {
    for (size, is_touch) in [([390.0, 844.0], true), ([1280.0, 720.0], false)] {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        harness.key_press(Key::F1);
        harness.run();
        let top = |text: &str| harness.get_by_label(text).rect().top();
        assert_eq!(top("With fingers") < top("With a mouse"), is_touch, "{size:?}");
        assert_eq!(top("With fingers") < top("Keys"), is_touch, "{size:?}");
    }
}

/// What each tool is, fingers are told by a word below its icon; each can be reached.
#[test]
fn tools_have_words_on_touch_screens() {
    for size in [[360.0, 640.0], [390.0, 844.0], [844.0, 390.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        touch(&mut harness);
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        if harness.query_by_label("Before").is_none() {
            press(&mut harness, "More tools");
        }
        for (name, word) in [
            ("Surprise me", "Surprise"),
            ("Mutate", "Mutate"),
            ("Share", "Share"),
            ("Find places", "Places"),
            ("Dive", "Dive"),
            ("Animate", "Animate"),
            ("Compare", "Compare"),
            ("Before", "Before"),
        ] {
            let tool = button(&harness, name).rect();
            assert!(tool.height() >= 44.0 && tool.width() >= 44.0, "{name}: {tool:?}");
            let words = painted(&harness, word);
            let is_near = words.iter().any(|at| {
                window.contains_rect(*at) && at.intersects(tool.expand2(egui::vec2(0.0, 18.0)))
            });
            assert!(is_near, "{name} in {size:?}: {tool:?}, {words:?}");
        }
    }
}

/// A wide picture has room for words below the icons; a narrow one with a mouse has hover texts alone.
#[test]
fn tools_have_words_in_wide_pictures() {
    for (size, has_words) in [
        ([1280.0, 720.0], true),
        ([1920.0, 1080.0], true),
        ([1000.0, 720.0], false),
        ([640.0, 420.0], false),
    ] {
        let harness = stage(presets::opening(), Settings::default(), size);
        let view = harness.state().interface.rects().get("view").expect("the view");
        let has_menu = harness.query_by_label("More tools").is_some();
        assert_eq!(has_menu, size[0] < 700.0, "only a narrow picture has a menu: {size:?}");
        for (name, word) in [
            ("Animate", "Animate"),
            ("Surprise me", "Surprise"),
            ("Mutate", "Mutate"),
            ("Share", "Share"),
            ("Find places", "Places"),
            ("Dive", "Dive"),
            ("Compare", "Compare"),
            ("Before", "Before"),
        ] {
            // The least used are in the menu, if there is one.
            if has_menu && ["Compare", "Before"].contains(&name) {
                continue;
            }
            let tool = button(&harness, name).rect();
            let below = |at: &Rect| {
                let is_below = at.top() >= tool.bottom() - 18.0 && view.contains_rect(*at);
                is_below && tool.x_range().contains(at.center().x)
            };
            let found = painted(&harness, word).iter().any(below);
            assert_eq!(found, has_words, "{name} in {size:?}: {tool:?}");
        }
        // Captions are beside or above the tools.
        let hint = harness.state().interface.rects().get("hint").expect("a hint");
        for name in ["Animate", "Dive"] {
            let tool = button(&harness, name).rect();
            assert!(!hint.intersects(tool), "{hint:?} covers {name} in {size:?}");
        }
    }
}

#[test]
fn the_offer_of_a_notice_is_a_button_in_the_window() {
    for size in WINDOWS {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        let text =
            "The graphics card stopped several times while it drew your last scene.".to_owned();
        let offer = Some("Open the scene anyway");
        harness.state_mut().notice = Some(Notice { text, is_error: true, offer });
        harness.run();
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        for label in ["Open the scene anyway", "Dismiss"] {
            let rect = harness.get_by_label(label).rect();
            assert!(window.contains_rect(rect), "{label}: {rect:?} in {size:?}");
        }
        press(&mut harness, "Open the scene anyway");
        assert_eq!(harness.state().actions, [mandelight::ui::Action::TakeOffer]);
    }
}

#[test]
fn help_lists_the_shortcuts_and_fits() {
    for size in WINDOWS {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        harness.key_press(Key::F1);
        harness.run();
        for (_, what) in
            mandelight::ui::shortcuts::SHORTCUTS.iter().filter_map(|shortcut| shortcut.help)
        {
            // A word of a help line may also stand elsewhere.
            let lines: Vec<_> = harness.get_all_by_label(what).map(|line| line.rect()).collect();
            let fits = |line: &Rect| line.left() >= 0.0 && line.right() <= size[0];
            assert!(lines.iter().all(fits), "{what} in {size:?}: {lines:?}");
        }
        harness.key_press(Key::Escape);
        harness.run();
        assert!(harness.query_by_label("Keys and gestures").is_none());
    }
}

/// A row that is wider than the panel would widen the rows below it too.
#[test]
fn no_row_is_wider_than_the_panel() {
    const MARGIN: f32 = 14.0;
    // The widest panel, a narrow one, and a sheet.
    for size in [[1280.0, 720.0], [640.0, 420.0], [390.0, 844.0]] {
        // Texts have other widths at each ratio.
        for ratio in [0.75, 1.0, 1.5, 2.0, 2.625, 3.0] {
            for has_touch in [false, true] {
                let mut harness =
                    stage(Scene::default(), unfolded(), size.map(|side| side * ratio));
                harness.set_pixels_per_point(ratio);
                harness.run();
                if has_touch {
                    touch(&mut harness);
                }
                for control in [
                    "Form: Julia",
                    "Mix with another formula",
                    "Mirror",
                    "Sky light: Sky",
                    "Add point light",
                    "Added: After curve",
                ] {
                    button(&harness, control).click_accesskit();
                    harness.run();
                }
                let case = format!("{size:?}, {ratio} pixels per point, touch: {has_touch}");
                let wide = wider_rows(&harness, size[0] - MARGIN);
                assert!(wide.is_empty(), "{case}: {wide:#?}");
                let panel = harness.state().interface.rects().get("panel").expect("the panel");
                assert!(panel.right() <= size[0], "{case}: {panel:?}");
            }
        }
    }
}

/// The first rows of the panel that end to the right of `most`.
fn wider_rows(harness: &egui_kittest::Harness<'_, Stage>, most: f32) -> Vec<String> {
    let panel = harness.state().interface.rects().get("panel").expect("the panel");
    let heading = button(harness, "Hide panel").rect().bottom();
    let nodes = harness.root().children_recursive();
    let nodes = nodes.filter(|node| node.accesskit_node().bounding_box().is_some());
    let rows = nodes.filter(|node| panel.x_range().contains(node.rect().center().x));
    // The row of lists of scenes scrolls sideways.
    let rects = harness.state().interface.rects();
    let lists = presets::lists().map(|list| list.name).into_iter().chain(["Mine"]);
    let lists: Vec<Rect> = lists.filter_map(|name| rects.get(name)).collect();
    let rows = rows.filter(|node| !lists.contains(&node.rect()));
    let wide = rows.filter_map(|node| {
        let label = node.accesskit_node().label().or(node.accesskit_node().value())?;
        let rect = node.rect();
        let is_wide = rect.top() > heading && rect.right() > most;
        is_wide.then(|| format!("{label}: {rect:?}"))
    });
    wide.take(5).collect()
}

/// Rows of buttons have one gap, and begin and end together.
#[test]
fn rows_of_buttons_are_alike() {
    let harness = workshop();
    let ends = |[first, last]: [&str; 2]| {
        let [first, last] = [first, last].map(|label| button(&harness, label).rect());
        (first.left(), last.right())
    };
    let gap = |[left, right]: [&str; 2]| {
        let [left, right] = [left, right].map(|label| button(&harness, label).rect());
        right.left() - left.right()
    };
    let lights = [["Add light", "Add point light"], ["Duplicate", "Remove"]];
    for row in lights {
        assert_eq!(gap(row), gap(["Home", "Frame all"]), "{row:?}");
        let ((left, right), (home, fly)) = (ends(row), ends(["Home", "Fly"]));
        // A row of three has another remainder of egui's unit of layout.
        assert!((left - home).abs() < 0.1 && (right - fly).abs() < 0.1, "{row:?}");
    }
}
