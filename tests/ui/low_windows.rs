//! Low windows, such as a phone that lies on its side: the picture keeps room, and rows scroll sideways.

use egui::{PointerButton, Rect, accesskit::Role};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    scene::{
        Project, Scene,
        path::{Easing, Key},
        presets,
    },
    ui::{ExportProgress, Settings},
};

use crate::stage::*;

const PHONE: [f32; 2] = [844.0, 390.0];

fn touched(project: impl Into<Project>, settings: Settings) -> Harness<'static, Stage> {
    let mut harness = without_motion(stage(project, settings, PHONE));
    touch(&mut harness);
    harness
}

fn rect(harness: &Harness<'_, Stage>, name: &str) -> Rect {
    harness.state().interface.rects().get(name).unwrap_or_else(|| panic!("no {name}"))
}

/// A project with two keys.
fn with_keys() -> Project {
    let key = |time_secs| Key { time_secs, easing: Easing::Smooth, scene: Scene::default().into() };
    let mut project = Project::from(Scene::default());
    project.path.keys = vec![key(0.0), key(3.0)];
    project
}

#[test]
fn the_timeline_leaves_the_picture_room() {
    for panel_open in [true, false] {
        let settings = Settings { timeline_open: true, panel_open, ..Settings::default() };
        let mut harness = touched(with_keys(), settings);
        harness.get_by_label("Key 2 at 3.00 s").click();
        harness.run();
        let view = rect(&harness, "view");
        assert!(view.height() >= 150.0, "{view:?} with the panel open: {panel_open}");
        // All buttons are in one row below the track.
        let track = rect(&harness, "timeline track");
        let tops: Vec<f32> = ["Add key", "Turntable", "Easing: Hold", "Save video"]
            .map(|name| button(&harness, name).rect().top())
            .to_vec();
        assert!(tops.iter().all(|top| *top == tops[0] && *top >= track.bottom()), "{tops:?}");
    }
}

#[test]
fn the_keyboard_reaches_what_is_scrolled_out_of_the_timeline() {
    let settings = Settings { timeline_open: true, ..Settings::default() };
    let mut harness = touched(with_keys(), settings);
    let strip = rect(&harness, "timeline");
    let is_seen = |harness: &Harness<'_, Stage>, name: &str| {
        let button = button(harness, name).rect();
        strip.left() <= button.left() && button.right() <= strip.right()
    };
    assert!(is_seen(&harness, "Add key") && !is_seen(&harness, "Save video"));
    for name in ["Save video", "Add key"] {
        button(&harness, name).focus();
        harness.run();
        harness.run_steps(30);
        let at = button(&harness, name).rect();
        assert!(is_seen(&harness, name), "{name}: {at:?} in {strip:?}");
    }
}

/// While a finger holds it, a sheet has any height.
#[test]
fn a_held_sheet_ends_at_the_window_s_edge() {
    let window = [390.0, 844.0];
    let mut harness = without_motion(stage(Scene::default(), Settings::default(), window));
    touch(&mut harness);
    let from = rect(&harness, "sheet handle").center();
    pointer(&harness, from, PointerButton::Primary, true, egui::Modifiers::NONE);
    let mut heights = Vec::new();
    for height in (54..230).step_by(4) {
        harness.event(egui::Event::PointerMoved(egui::pos2(from.x, window[1] - height as f32)));
        harness.run_steps(2);
        let panel = rect(&harness, "panel");
        assert!((panel.bottom() - window[1]).abs() < 0.5, "{panel:?} held at {height}");
        heights.push(panel.height());
    }
    assert!(heights.is_sorted() && heights[0] < 100.0, "{heights:?}");
    assert!(heights.last().is_some_and(|height| *height > 180.0), "{heights:?}");
}

#[test]
fn a_plain_wheel_moves_the_timeline_s_row() {
    let settings = Settings { timeline_open: true, ..Settings::default() };
    let mut harness = without_motion(stage(with_keys(), settings, [720.0, 420.0]));
    harness.run();
    let strip = rect(&harness, "timeline");
    let last = button(&harness, "Save video").rect();
    assert!(last.left() > strip.right(), "{last:?} is in sight");
    harness.event(egui::Event::PointerMoved(egui::pos2(strip.center().x, last.center().y)));
    harness.event(wheel(-2000.0));
    harness.run_steps(30);
    let last = button(&harness, "Save video").rect();
    assert!(last.right() <= strip.right(), "{last:?} in {strip:?}");
}

#[test]
fn the_time_left_stands_whole_beside_cancel() {
    let settings = Settings { panel_open: false, timeline_open: true, ..Settings::default() };
    for size in [[720.0, 420.0], [640.0, 360.0]] {
        let mut harness = without_motion(stage(with_keys(), settings.clone(), size));
        let hours = 123.0 * 3600.0 + 59.0 * 60.0;
        harness.state_mut().export =
            Some(ExportProgress { done: 0.3, remaining_secs: Some(hours) });
        harness.run();
        // In a low window it is at the end of a row that scrolls.
        let strip = rect(&harness, "timeline");
        harness.event(egui::Event::PointerMoved(strip.center_bottom() - egui::vec2(0.0, 20.0)));
        harness.event(wheel(-2000.0));
        harness.run_steps(30);
        let times = painted_texts(&harness)
            .filter(|text| text.galley.text() == "Saving, 123 h 59 min left");
        let [time] = times.collect::<Vec<_>>()[..] else { panic!("no time in {size:?}") };
        assert!(!time.galley.elided && time.galley.rows.len() == 1, "cut off in {size:?}");
        let (time, cancel) = (time.visual_bounding_rect(), rect(&harness, "cancel export"));
        assert!(time.right() < cancel.left(), "{time:?} and {cancel:?} in {size:?}");
    }
}

/// Only what contains a control scrolls to it.
#[test]
fn the_panel_stays_while_the_keyboard_is_in_the_timeline() {
    let settings = Settings { timeline_open: true, ..Settings::default() };
    let mut harness = touched(with_keys(), settings);
    let names = ["panel", "power", "exposure", "Opening", "Mine"];
    let places = |harness: &Harness<'_, Stage>| {
        names.map(|name| harness.state().interface.rects().get(name))
    };
    let before = places(&harness);
    assert!(before.iter().flatten().count() >= 4, "{before:?}");
    button(&harness, "Save video").focus();
    harness.run_steps(30);
    assert_eq!(places(&harness), before);
}

#[test]
fn the_lists_of_scenes_are_one_row() {
    for (size, has_touch) in [
        (PHONE, true),
        ([640.0, 420.0], true),
        ([640.0, 420.0], false),
        ([390.0, 844.0], true),
        ([1280.0, 720.0], false),
    ] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        if has_touch {
            touch(&mut harness);
        }
        let names = presets::lists().map(|list| list.name);
        let tops: Vec<f32> =
            names.into_iter().chain(["Mine"]).map(|name| rect(&harness, name).top()).collect();
        assert!(tops.iter().all(|top| *top == tops[0]), "{tops:?} in {size:?}");
        let panel = rect(&harness, "panel");
        button(&harness, "Mine").focus();
        harness.run();
        harness.run_steps(30);
        let mine = rect(&harness, "Mine");
        assert!(mine.right() <= panel.right(), "{mine:?} in {panel:?} of {size:?}");
    }
}

/// The set stands in the middle: the tools at the lower edge stay on the left of it.
#[test]
fn the_tools_leave_the_middle_of_a_low_picture_free() {
    let harness = touched(presets::opening(), Settings::default());
    let view = rect(&harness, "view");
    let nodes = harness.root().children_recursive();
    let tools: Vec<Rect> = nodes
        .filter(|node| node.accesskit_node().role() == Role::Button)
        .map(|node| node.rect())
        .filter(|rect| view.contains_rect(*rect) && rect.top() > view.center().y)
        .collect();
    assert!(tools.len() >= 4, "{tools:?}");
    let right = tools.iter().map(Rect::right).fold(f32::MIN, f32::max);
    assert!(right <= view.center().x, "{right} of {view:?}");
}
