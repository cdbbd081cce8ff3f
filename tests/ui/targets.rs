//! On a touch screen every control is large enough for a finger.

use egui::{Key, Modifiers, accesskit::Role};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    formula::{self, Fractal},
    scene::{Project, Scene, document, presets},
    ui::{ExportProgress, GalleryState, Notice, Settings, thumbnail},
};

use crate::stage::*;

/// Least width and height of a target for fingers, in points.
const LEAST: f32 = 44.0;

/// Controls that are smaller than a finger.
fn small(harness: &Harness<'_, Stage>) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    let nodes = nodes.filter(|node| {
        let node = node.accesskit_node();
        let is_input = egui::accessibility::is_input(node.role());
        // egui's edges of a window, which only make it larger.
        is_input && node.role() != Role::Splitter && node.bounding_box().is_some()
    });
    let small = nodes.filter_map(|node| {
        let size = node.rect().size();
        let name = node.accesskit_node().label().or(node.accesskit_node().value());
        let role = node.accesskit_node().role();
        (size.min_elem() < LEAST - 0.1).then(|| format!("{role:?} {name:?} {size:?}"))
    });
    let mut small: Vec<String> = small.collect();
    small.sort();
    small.dedup();
    small
}

#[derive(Default)]
struct Seen {
    controls: usize,
    small: Vec<String>,
}

impl Seen {
    fn look(&mut self, what: &str, harness: &Harness<'_, Stage>) {
        let nodes = harness.root().children_recursive();
        self.controls += nodes
            .filter(|node| egui::accessibility::is_input(node.accesskit_node().role()))
            .count();
        self.small.extend(small(harness).into_iter().map(|small| format!("{what}: {small}")));
    }

    /// No control was too small, of more than so many.
    fn assert_large(&self, controls: usize) {
        assert!(self.controls > controls, "{}", self.controls);
        let count = self.small.len();
        assert!(self.small.is_empty(), "{count} are too small: {:#?}", self.small);
    }
}

/// A stage whose screen is touched.
fn touched(
    project: impl Into<Project>,
    settings: Settings,
    size: [f32; 2],
) -> Harness<'static, Stage> {
    let mut harness = without_motion(stage(project, settings, size));
    touch(&mut harness);
    harness
}

fn press_each(harness: &mut Harness<'_, Stage>, labels: &[&str]) {
    for label in labels {
        let found = harness.query_all_by_label(label);
        found.last().unwrap_or_else(|| panic!("no {label}")).click_accesskit();
        harness.run();
    }
}

#[test]
fn controls_have_room_for_fingers() {
    let mut seen = Seen::default();
    for size in [[390.0, 844.0], [844.0, 390.0], [1280.0, 6000.0]] {
        for settings in [Settings::default(), unfolded()] {
            let mut harness = touched(presets::opening(), settings, size);
            let case = |what: &str| format!("{what} in {size:?}");
            seen.look(&case("the panel"), &harness);
            press_each(&mut harness, &["Mine"]);
            seen.look(&case("one's own"), &harness);
            for (key, modifiers, what) in [
                (Key::F1, Modifiers::NONE, "help"),
                (Key::J, Modifiers::NONE, "sharing"),
                (Key::M, Modifiers::NONE, "variations"),
            ] {
                harness.key_press_modifiers(modifiers, key);
                harness.run_steps(14);
                seen.look(&case(what), &harness);
                harness.key_press(Key::Escape);
                harness.run_steps(4);
            }
            harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
            harness.run_steps(4);
            harness.event(egui::Event::Text("light".to_owned()));
            harness.run_steps(4);
            seen.look(&case("finding"), &harness);
            harness.key_press(Key::Escape);
            harness.run_steps(4);
            harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
            harness.run_steps(4);
            seen.look(&case("comparing"), &harness);
        }
    }
    let mut harness = touched(Scene::default(), unfolded(), [390.0, 6000.0]);
    press_each(
        &mut harness,
        &[
            "Form: Julia",
            "Sky light: Sky",
            "Add point light",
            "Added: After curve",
            "Cut open",
            "Stereo: Stacked",
            "Picture size: Custom",
            "File: JPEG",
            "Second layer",
        ],
    );
    seen.look("many options", &harness);
    press_each(&mut harness, &["Choose a gradient…"]);
    seen.look("gradients", &harness);
    harness.key_press(Key::Escape);
    harness.run();
    press_each(&mut harness, &["Mix with another formula"]);
    seen.look("formulas", &harness);
    press_each(&mut harness, &["Mirror"]);
    seen.look("a hybrid", &harness);
    press_each(&mut harness, &["Mine"]);
    let kept = document::project_to_json_compact(harness.state().interface.project());
    let jpeg = thumbnail::jpeg(&presets::opening_scenes()[0]).expect("a picture");
    harness.state_mut().interface.keep_favourite(kept, jpeg.to_vec());
    harness.state_mut().export = Some(ExportProgress { done: 0.4, remaining_secs: Some(75.0) });
    harness.run();
    press_each(&mut harness, &["View 1"]);
    seen.look("a kept view, while a picture is saved", &harness);
    seen.assert_large(1000);
}

#[test]
fn messages_menus_and_the_timeline_have_room_for_fingers() {
    let mut seen = Seen::default();
    for size in [[390.0, 844.0], [844.0, 390.0], [1280.0, 900.0]] {
        let mut harness = touched(presets::opening(), Settings::default(), size);
        let case = |what: &str| format!("{what} in {size:?}");
        harness.state_mut().notice =
            Some(Notice { text: "A failure".to_owned(), is_error: true, offer: Some("Open it") });
        harness.state_mut().reading = Some("garden.hdr".to_owned());
        harness.state_mut().gallery = Some(GalleryState::Failed("No list".to_owned()));
        harness.run();
        seen.look(&case("messages"), &harness);
        harness.state_mut().notice = None;
        if harness.query_by_label("More tools").is_some() {
            press(&mut harness, "More tools");
            seen.look(&case("tools"), &harness);
            harness.key_press(Key::Escape);
            harness.run();
        }
        harness.get_by_label("Key light colour").click_accesskit();
        harness.run();
        seen.look(&case("a colour"), &harness);
        harness.key_press(Key::Escape);
        harness.run();
        harness.key_press(Key::T);
        harness.run();
        for _ in 0..2 {
            harness.key_press(Key::K);
            harness.run();
        }
        seen.look(&case("the timeline"), &harness);
        harness.get_by_label("Kind of file").click_accesskit();
        harness.run();
        seen.look(&case("kinds of files"), &harness);
    }
    let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
    let scene = Scene { fractal, ..Scene::default() };
    let mut harness = touched(scene, unfolded(), [1280.0, 6000.0]);
    press(&mut harness, "Edit the formula…");
    harness.get_by_label("Formula text").focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run();
    harness.event(egui::Event::Text("name \"A\"; step { z = quaternion_p".to_owned()));
    harness.run_steps(40);
    harness.get_by_label_contains("quaternion_p");
    seen.look("the formula editor", &harness);
    seen.assert_large(200);
}

#[test]
fn what_lies_over_the_picture_has_room_for_fingers() {
    let mut seen = Seen::default();
    let mut scene = Scene::default();
    scene.lights.point.push(mandelight::scene::PointLight {
        position: scene.camera.pivot.clone(),
        ..Default::default()
    });
    let begun = scene.camera.view_unit();
    let mut harness = touched(scene, Settings::default(), [390.0, 844.0]);
    harness.get_by_label("Point light 1 in the view");
    seen.look("a light", &harness);
    harness.get_by_label("Find places").click_accesskit();
    harness.run_steps(3);
    let is_pin =
        |harness: &Harness<'_, Stage>| harness.query_by_label_contains("Place 1").is_some();
    for _ in 0..3000 {
        if is_pin(&harness) {
            break;
        }
        harness.step();
    }
    assert!(is_pin(&harness), "no pins");
    seen.look("pins", &harness);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    harness.state_mut().reduced_motion = false;
    harness.key_press(Key::D);
    let mut frames = 0;
    while crate::stage::scene(&harness).camera.view_unit() > 0.5 * begun {
        harness.step();
        frames += 1;
        assert!(frames < 100_000, "no dive");
    }
    harness.key_press(Key::D);
    harness.run_steps(3);
    harness.get_by_label("Keep as a path");
    seen.look("a dive", &harness);
    seen.assert_large(0);
}
