//! The interface as a screen reader reads it, without a browser.

use std::{cell::RefCell, collections::HashSet};

use egui::accesskit::Action;
use egui_kittest::{Harness, kittest::NodeT as _};
use mandelight::{
    scene::Scene,
    ui::{
        Settings,
        accessibility::{Element, Elements, Kind, Request, ScreenReader},
    },
};

use crate::stage::*;

thread_local! {
    /// What the screen reader was shown, in order. Each test has a thread of its own.
    static SHOWN: RefCell<Vec<Elements>> = const { RefCell::new(Vec::new()) };
}

fn record(elements: &Elements) {
    SHOWN.with_borrow_mut(|shown| shown.push(elements.clone()));
}

fn shown() -> Elements {
    SHOWN.with_borrow(|shown| shown.last().cloned().expect("nothing was shown"))
}

/// An interface that a screen reader reads.
fn read(settings: Settings, size: [f32; 2]) -> Harness<'static, Stage> {
    let mut harness = without_motion(stage(Scene::default(), settings, size));
    harness.ctx.add_plugin(ScreenReader::new(record, 0.0));
    harness.run();
    harness
}

fn request(harness: &mut Harness<'_, Stage>, element: &Element, request: Request) {
    harness.ctx.plugin::<ScreenReader>().lock().request(&element.id, &request);
    harness.run();
}

fn find(name: &str, is_kind: impl Fn(Kind) -> bool) -> Element {
    let found = shown().elements.into_iter().find(|it| it.name == name && is_kind(it.kind));
    found.unwrap_or_else(|| panic!("{name} is not among {:#?}", names()))
}

fn names() -> Vec<String> {
    shown().elements.into_iter().map(|element| element.name).collect()
}

fn is_button(kind: Kind) -> bool {
    matches!(kind, Kind::Button { .. })
}

fn is_slider(kind: Kind) -> bool {
    matches!(kind, Kind::Slider(_))
}

/// Nothing that the keyboard reaches is missing, and nothing is there twice.
#[test]
fn every_control_is_an_element_with_a_name() {
    for size in [[1280.0, 6000.0], [390.0, 844.0]] {
        let harness = read(unfolded(), size);
        let elements = shown().elements;
        let ids: HashSet<&str> = elements.iter().map(|element| element.id.as_str()).collect();
        assert_eq!(ids.len(), elements.len());
        for node in harness.root().children_recursive() {
            let node = node.accesskit_node();
            let name = node.label().unwrap_or_default();
            if node.data().supports_action(Action::Focus) {
                let is_there = elements.iter().any(|element| element.name == name);
                assert!(is_there, "{:?} {name:?} is missing", node.role());
            }
        }
        let nameless: Vec<_> = elements.iter().filter(|element| element.name.is_empty()).collect();
        assert!(nameless.is_empty(), "{nameless:#?}");
    }
}

/// From the header down to what is at the end of the panel.
#[test]
fn elements_come_in_reading_order() {
    let _harness = read(Settings::default(), [1280.0, 2000.0]);
    let names = names();
    let order = ["Fullscreen", "Hide panel", "Scenes", "Power", "Save picture"];
    let places = order.map(|name| names.iter().position(|it| it == name));
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{names:#?}");
}

/// Opening a scene, changing the power and saving need no picture to point at.
#[test]
fn requests_do_what_pointers_do() {
    let mut harness = read(Settings::default(), [1280.0, 720.0]);
    request(&mut harness, &find("Power", is_slider), Request::SetNumber(5.0));
    let Kind::Slider(power) = find("Power", is_slider).kind else { unreachable!() };
    assert_eq!(power.now, 5.0);
    assert!(power.min < power.max, "{power:?}");

    let before = harness.state().interface.scene().clone();
    let card = mandelight::scene::presets::opening_scenes()[2].name;
    let card = names().into_iter().find(|name| name.contains(card)).expect("a scene's card");
    request(&mut harness, &find(&card, is_button), Request::Press);
    assert_ne!(*harness.state().interface.scene(), before);

    harness.state_mut().actions.clear();
    request(&mut harness, &find("Save picture", is_button), Request::Press);
    assert_eq!(harness.state().actions.len(), 1, "{:?}", harness.state().actions);
}

/// The screen reader hears of the keyboard's moves, and can make them.
#[test]
fn the_keyboard_is_in_one_place() {
    let mut harness = read(Settings::default(), [1280.0, 720.0]);
    let power = find("Power", is_slider);
    request(&mut harness, &power, Request::Focus);
    assert_eq!(shown().focus.as_deref(), Some(power.id.as_str()));
    harness.key_press(egui::Key::Tab);
    harness.run();
    let next = shown().focus.expect("a focus");
    let next = shown().elements.into_iter().find(|element| element.id == next).unwrap();
    assert_eq!(next.name, "Power 2");
}

/// An open section says so.
#[test]
fn sections_say_whether_they_are_open() {
    let mut harness = read(Settings::default(), [1280.0, 2000.0]);
    let expanded = |name: &str| match find(name, is_button).kind {
        Kind::Button { expanded, .. } => expanded,
        _ => None,
    };
    assert_eq!(expanded("More"), Some(false));
    request(&mut harness, &find("More", is_button), Request::Press);
    assert_eq!(expanded("More"), Some(true));
}

/// While something moves, trees are rare; at rest, the last is shown and no further frame requested.
#[test]
fn trees_are_rare_and_the_last_is_not_missed() {
    /// The last frame with a change; its tree has to wait.
    const LAST: u32 = 55;
    let context = egui::Context::default();
    context.add_plugin(ScreenReader::new(record, 0.2));
    let frame = |count: u32| {
        let time = Some(f64::from(count) / 60.0);
        let input = egui::RawInput { time, ..Default::default() };
        let mut output = context.run_ui(input, |ui| {
            ui.label(format!("frame {}", count.min(LAST)));
        });
        output.textures_delta.clear();
        output.viewport_output.values().map(|viewport| viewport.repaint_delay).min()
    };
    for count in 1..=LAST {
        frame(count);
    }
    let trees = SHOWN.with_borrow(Vec::len);
    assert!((4..=5).contains(&trees), "{trees} trees in {LAST} frames");
    assert_ne!(names(), [format!("frame {LAST}")]);
    let later = frame(LAST + 1).expect("a viewport");
    assert!(later.as_secs_f64() <= 0.2, "the last change may be missed: {later:?}");
    let never = frame(90).expect("a viewport");
    assert!(never.as_secs_f64() > 1e6, "an idle page draws again after {never:?}");
    assert_eq!(names(), [format!("frame {LAST}")]);
}
