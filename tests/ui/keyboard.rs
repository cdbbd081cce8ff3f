//! The interface by keyboard and screen reader: the order of the Tab key, and names.

use egui::{Key, Rect, accesskit::Action};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{scene::Scene, ui::Settings};

use crate::stage::*;

/// The focused widget's name and place.
fn focused(harness: &Harness<'_, Stage>) -> Option<(String, Rect)> {
    let node =
        harness.root().children_recursive().find(|node| node.accesskit_node().is_focused())?;
    Some((node.accesskit_node().label().unwrap_or_default(), node.rect()))
}

/// What the Tab key visits, until it comes back to the first or `most` are visited.
fn visited(harness: &mut Harness<'_, Stage>, most: usize) -> Vec<(String, Rect)> {
    let mut visited: Vec<(String, Rect)> = Vec::new();
    for _ in 0..most {
        harness.key_press(Key::Tab);
        harness.run();
        let Some(next) = focused(harness) else { continue };
        if visited.first() == Some(&next) {
            break;
        }
        visited.push(next);
    }
    visited
}

/// Down the panel, and in each row from left to right.
#[test]
fn tab_goes_through_the_panel_in_reading_order() {
    for size in [[1280.0, 2000.0], [390.0, 844.0]] {
        let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
        let visited = visited(&mut harness, 80);
        let panel = harness.state().interface.rects().get("panel").expect("the panel");
        let in_panel: Vec<_> =
            visited.iter().filter(|(_, rect)| panel.contains(rect.center())).collect();
        assert!(in_panel.len() > 10, "{visited:#?}");
        let heading: Vec<&str> = in_panel.iter().map(|(name, _)| name.as_str()).collect();
        let place = |name: &str| heading.iter().position(|it| *it == name);
        let order = ["Fullscreen", "Help", "Hide panel", "Scenes", "Power", "Save picture"];
        let places = order.map(place);
        assert!(places.iter().all(Option::is_some), "{heading:?}");
        // A low sheet scrolls the button with the rest, between the first controls and the others.
        assert!(places.is_sorted(), "{heading:?}");
        assert!(heading.iter().all(|name| !name.is_empty()), "{heading:?}");
    }
}

/// Whether `next` comes after `before` for a reader: in a row from left to right, else below.
fn is_read_after(before: Rect, next: Rect) -> bool {
    let both = before.y_range().intersection(next.y_range()).span();
    let is_in_row = both > 0.5 * before.height().min(next.height());
    if is_in_row { next.left() >= before.left() - 0.5 } else { next.top() > before.top() - 0.5 }
}

/// The places that the Tab key visits in the panel go from the top to the bottom, and in rows from left to right.
#[test]
fn tab_visits_the_places_of_the_panel_in_reading_order() {
    let with_sections = |names: &[&str]| {
        let mut settings = Settings { more_open: true, ..Settings::default() };
        names.iter().for_each(|name| settings.sections.set_open(name, true));
        settings
    };
    for settings in [
        Settings::default(),
        with_sections(&["lights", "tone"]),
        with_sections(&["colors", "export", "camera"]),
    ] {
        let size = [1280.0, 3000.0];
        let mut harness = without_motion(stage(Scene::default(), settings, size));
        let visited = visited(&mut harness, 150);
        let panel = harness.state().interface.rects().get("panel").expect("the panel");
        let in_panel: Vec<_> =
            visited.iter().filter(|(_, rect)| panel.contains(rect.center())).collect();
        assert!(in_panel.len() > 20, "{}", in_panel.len());
        for pair in in_panel.windows(2) {
            assert!(is_read_after(pair[0].1, pair[1].1), "{pair:#?}");
        }
    }
}

/// In windows too, and it reaches all their controls. (The finder keeps the keyboard in its field, and arrows choose.)
#[test]
fn tab_visits_the_places_of_windows_in_reading_order() {
    for (name, key) in [("share window", Key::J), ("help window", Key::F1), ("variations", Key::M)]
    {
        // Wide enough that only the picture lies below them.
        let size = [1280.0, 900.0];
        let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
        harness.key_press(key);
        harness.run();
        let window = harness.state().interface.rects().get(name).expect(name);
        // The picture and its handles lie below.
        let is_inside = |(label, rect): &(String, Rect)| {
            window.contains_rect(*rect) && !label.ends_with(" in the view")
        };
        let controls = harness.root().children_recursive().filter_map(|node| {
            let control = node.accesskit_node();
            let is_used = egui::accessibility::is_input(control.role());
            (is_used && !control.is_disabled())
                .then(|| (control.label().unwrap_or_default(), node.rect()))
        });
        let controls: Vec<_> = controls.filter(is_inside).collect();
        assert!(!controls.is_empty(), "{name}");
        let mut inside = visited(&mut harness, 150);
        inside.retain(is_inside);
        for control in controls {
            assert!(inside.contains(&control), "{name}: {control:?} of {inside:#?}");
        }
        for pair in inside.windows(2) {
            assert!(is_read_after(pair[0].1, pair[1].1), "{name}: {pair:#?}");
        }
    }
}

/// The Tab key reaches whatever a screen reader could focus: panel, header, timeline, the view and its buttons.
#[test]
fn tab_reaches_every_control() {
    let timeline = Settings { timeline_open: true, ..Settings::default() };
    let cases = [(Settings::default(), 900.0), (unfolded(), 6000.0), (timeline, 900.0)];
    for (settings, height) in cases {
        let mut harness = without_motion(stage(Scene::default(), settings, [1280.0, height]));
        let visited = visited(&mut harness, 500);
        let wanted: Vec<(String, Rect)> = harness
            .root()
            .children_recursive()
            .filter(|node| {
                let node = node.accesskit_node();
                let is_used = egui::accessibility::is_input(node.role())
                    || node.data().supports_action(Action::Focus);
                is_used && !node.is_disabled()
            })
            .map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()))
            .collect();
        assert!(wanted.len() > 20, "{}", wanted.len());
        // By name, since what has the keyboard may scroll the panel; as often as the name is there.
        let count =
            |all: &[(String, Rect)], name: &str| all.iter().filter(|it| it.0 == name).count();
        let missed: Vec<&str> = wanted
            .iter()
            .map(|(name, _)| name.as_str())
            .filter(|name| name.is_empty() || count(&visited, name) < count(&wanted, name))
            .collect();
        assert!(missed.is_empty(), "of {}: {missed:#?}", wanted.len());
    }
}

#[test]
fn the_measure_knows_reading_order() {
    let rect =
        |left: f32, top: f32| Rect::from_min_size(egui::pos2(left, top), egui::vec2(40.0, 20.0));
    assert!(is_read_after(rect(0.0, 0.0), rect(50.0, 2.0)), "to the right");
    assert!(is_read_after(rect(50.0, 0.0), rect(0.0, 30.0)), "the next row");
    assert!(!is_read_after(rect(50.0, 0.0), rect(0.0, 2.0)), "to the left");
    assert!(!is_read_after(rect(0.0, 30.0), rect(50.0, 0.0)), "up");
}

/// A screen reader can name every control that can be used.
#[test]
fn every_control_has_a_name() {
    for size in [[1280.0, 6000.0], [390.0, 844.0]] {
        let harness = stage(Scene::default(), unfolded(), size);
        let nameless: Vec<String> = harness
            .root()
            .children_recursive()
            .filter(|node| {
                let node = node.accesskit_node();
                let name = node.label().or_else(|| node.value()).unwrap_or_default();
                let is_used = egui::accessibility::is_input(node.role())
                    || node.data().supports_action(Action::Focus);
                is_used && name.trim().is_empty()
            })
            .map(|node| format!("{:?} at {:?}", node.accesskit_node().role(), node.rect()))
            .collect();
        assert!(nameless.is_empty(), "{nameless:#?}");
    }
}

/// With the keyboard, the view turns by the arrow keys and keeps it; the Tab key goes on.
#[test]
fn the_arrow_keys_turn_the_view_that_has_the_keyboard() {
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), [1280.0, 720.0]));
    let is_at_view =
        |harness: &Harness<'_, Stage>| focused(harness).is_some_and(|(name, _)| name == "View");
    for _ in 0..80 {
        if is_at_view(&harness) {
            break;
        }
        harness.key_press(Key::Tab);
        harness.run();
    }
    for key in [Key::ArrowLeft, Key::ArrowUp] {
        let before = scene(&harness).camera.clone();
        harness.key_press(key);
        harness.run();
        assert!(is_at_view(&harness), "{key:?} moved the keyboard to {:?}", focused(&harness));
        assert_ne!(scene(&harness).camera, before, "{key:?}");
    }
    harness.key_press(Key::Tab);
    harness.run();
    assert!(!is_at_view(&harness));
}

/// The closed menu of tools returns the focus to its button, after a choice and after Escape; not to someone with a mouse.
#[test]
fn a_closed_menu_returns_the_focus() {
    let size = [640.0, 420.0];
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
    let name_in_focus = |harness: &Harness<'_, Stage>| focused(harness).map(|(name, _)| name);
    for keys in [&[Key::Escape][..], &[Key::Tab, Key::Enter]] {
        harness.get_by_label("More tools").focus();
        harness.run();
        harness.key_press(Key::Enter);
        harness.run();
        harness.get_by_label("Compare");
        for &key in keys {
            harness.key_press(key);
            harness.run();
            let is_inside = name_in_focus(&harness).is_some_and(|name| name != "More tools");
            assert_eq!(is_inside, key == Key::Tab, "{key:?}");
        }
        assert!(harness.query_by_label("Compare").is_none(), "{keys:?}: the menu is open");
        assert_eq!(name_in_focus(&harness).as_deref(), Some("More tools"), "{keys:?}");
    }
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), size));
    let more = harness.get_by_label("More tools").rect().center();
    drag(&mut harness, more, more, 1);
    harness.run();
    harness.get_by_label("Compare");
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.query_by_label("Compare").is_none());
    assert_eq!(name_in_focus(&harness), None);
}
