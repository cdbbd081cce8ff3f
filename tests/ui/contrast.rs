//! Every text of the interface stands out from what is behind it.

use std::collections::BTreeMap;

use egui::{Color32, Event, Key, Modifiers, Pos2, Rgba, Shape, epaint::TextShape};
use egui_kittest::{
    Harness,
    kittest::{NodeT as _, Queryable as _},
};
use mandelight::{
    formula::{self, Fractal},
    scene::{Scene, presets},
    ui::{GalleryState, Notice, Settings, ViewTexture, theme},
};

use crate::stage::*;

/// Least contrast of text (WCAG 2.2, success criterion 1.4.3, level AA).
const LEAST: f32 = 4.5;
/// Least size of text, in points.
const LEAST_SIZE: f32 = 12.0;
/// Relative luminance (WCAG 2.2).
fn luminance(color: Color32) -> f32 {
    let linear = Rgba::from(color);
    0.2126 * linear.r() + 0.7152 * linear.g() + 0.0722 * linear.b()
}

fn contrast(a: Color32, b: Color32) -> f32 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// The colours that can be at `at` after `shapes`: black and white for a picture, none for a gradient.
fn behind(shapes: &[&Shape], at: Pos2) -> Vec<Color32> {
    // Under the first shape lies the page's background.
    let mut colors = vec![theme::BACKGROUND];
    for shape in shapes {
        match shape {
            Shape::Rect(rect) if rect.rect.contains(at) => {
                if rect.brush.is_some() {
                    colors = vec![Color32::BLACK, Color32::WHITE];
                } else if rect.fill.a() == 255 {
                    colors = vec![rect.fill];
                } else {
                    colors.iter_mut().for_each(|under| *under = under.blend(rect.fill));
                }
            }
            Shape::Circle(circle) if circle.center.distance(at) < circle.radius => {
                colors.iter_mut().for_each(|under| *under = under.blend(circle.fill));
            }
            Shape::Mesh(mesh) if mesh.calc_bounds().contains(at) => {
                let is_picture = mesh.texture_id == VIEW.texture;
                colors = if is_picture { vec![Color32::BLACK, Color32::WHITE] } else { Vec::new() };
            }
            _ => {}
        }
    }
    colors
}

/// A picture in the view, of any colours.
const VIEW: ViewTexture = ViewTexture { texture: egui::TextureId::User(7), size_px: [1280, 720] };

fn color_of(text: &TextShape) -> Color32 {
    let section = text.galley.job.sections.first().map(|section| section.format.color);
    let color =
        section.filter(|&color| color != Color32::PLACEHOLDER).unwrap_or(text.fallback_color);
    text.override_text_color.unwrap_or(color).gamma_multiply(text.opacity_factor)
}

/// Texts that do not stand out, with their contrast; and the number of texts that were looked at.
fn weak_texts(harness: &Harness<'_, Stage>) -> (BTreeMap<String, f32>, usize) {
    let shapes = shapes(harness);
    let (mut weak, mut count) = (BTreeMap::new(), 0);
    for (index, shape) in shapes.iter().enumerate() {
        let Shape::Text(text) = shape else { continue };
        let words = text.galley.text().trim();
        let rect = text.visual_bounding_rect();
        if words.is_empty() || !rect.is_finite() {
            continue;
        }
        let grounds = behind(&shapes[..index], rect.center());
        if grounds.is_empty() {
            continue;
        }
        count += 1;
        let smallest = text.galley.job.sections.iter().map(|part| part.format.font_id.size);
        assert!(smallest.fold(f32::MAX, f32::min) >= LEAST_SIZE, "{words} is too small");
        let ratio = |ground: Color32| contrast(ground.blend(color_of(text)), ground);
        let ratio = grounds.into_iter().map(ratio).fold(f32::MAX, f32::min);
        if ratio < LEAST {
            weak.insert(words.to_owned(), ratio);
        }
    }
    (weak, count)
}

#[test]
fn texts_stand_out_in_every_panel() {
    let mut seen = 0;
    let mut check = |what: &str, harness: &Harness<'_, Stage>| {
        let (weak, count) = weak_texts(harness);
        seen += count;
        assert!(weak.is_empty(), "{what}: {weak:?}");
    };
    let mut harness = workshop();
    harness.run();
    check("everything unfolded", &harness);
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 720.0]);
    harness.state_mut().notice =
        Some(Notice { text: "A failure".to_owned(), is_error: true, ..Notice::default() });
    harness.state_mut().gallery = Some(GalleryState::Failed("No list is there".to_owned()));
    harness.run();
    press(&mut harness, "Gallery");
    check("a failure", &harness);
    press(&mut harness, "Animate");
    check("the timeline", &harness);
    let mut harness = stage(Scene::default(), Settings::default(), [390.0, 844.0]);
    harness.run();
    check("a phone", &harness);
    assert!(seen > 300, "{seen}");
}

/// A stage with a picture in its view, after keys.
fn shown(settings: Settings, keys: &[(Modifiers, Key)]) -> Harness<'static, Stage> {
    let mut harness = without_motion(stage(presets::opening(), settings, [1280.0, 720.0]));
    harness.state_mut().picture = Some(VIEW);
    harness.run();
    for &(modifiers, key) in keys {
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(14);
    }
    harness
}

fn assert_strong(what: &str, harness: &Harness<'_, Stage>) {
    let (weak, count) = weak_texts(harness);
    assert!(count > 20, "{what}: {count}");
    assert!(weak.is_empty(), "{what}: {weak:?}");
}

#[test]
fn texts_stand_out_in_windows_and_over_any_picture() {
    const NONE: Modifiers = Modifiers::NONE;
    let flight_keys =
        "W  S · A  D · E  Q to fly, Shift for faster, drag to look around, Esc to stop";
    for (what, key, modifiers, words) in [
        ("sharing", Key::J, NONE, "Copy picture"),
        ("help", Key::F1, NONE, "With a mouse"),
        ("variations", Key::M, NONE, "Eight more"),
        ("comparing", Key::C, Modifiers::SHIFT, "A"),
        ("the keys of fly mode", Key::F, NONE, flight_keys),
    ] {
        let harness = shown(Settings::default(), &[(modifiers, key)]);
        assert!(!painted(&harness, words).is_empty(), "{what}");
        assert_strong(what, &harness);
    }
    let mut harness = shown(Settings::default(), &[(Modifiers::COMMAND, Key::K)]);
    harness.event(Event::Text("light".to_owned()));
    harness.run_steps(4);
    assert_strong("finding", &harness);
    harness.event(Event::Text("no such thing".to_owned()));
    harness.run_steps(4);
    assert!(!painted(&harness, "Nothing is called that.").is_empty());
    assert_strong("finding nothing", &harness);
    let mut harness = shown(Settings::default(), &[]);
    button(&harness, "Light a place").click_accesskit();
    harness.run();
    assert!(!painted(&harness, "Click a place to light it · Esc to stop").is_empty());
    assert_strong("a caption", &harness);
    let mut harness = shown(Settings::default(), &[]);
    button(&harness, "Find places").click();
    harness.run_steps(4);
    assert_strong("the search for places", &harness);
    for _ in 0..3000 {
        if harness.query_by_label_contains("Place 1:").is_some() {
            break;
        }
        harness.step();
    }
    harness.get_by_label_contains("Place 1:");
    assert_strong("pins", &harness);
}

#[test]
fn texts_of_the_formula_editor_stand_out() {
    let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
    let scene = Scene { fractal, ..Scene::default() };
    let mut harness = stage(scene, unfolded(), [1280.0, 3000.0]);
    press(&mut harness, "Edit the formula…");
    assert_strong("the formula editor", &harness);
    harness.get_by_label("Formula text").focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run();
    harness.event(Event::Text("name \"A\"; step { z = quaternion_p".to_owned()));
    harness.run_steps(3);
    assert_strong("completions", &harness);
    harness.run_steps(40);
    assert_strong("an error", &harness);
    harness.get_by_label("Functions").click();
    harness.run();
    assert!(!painted(&harness, "Functions").is_empty());
    assert_strong("functions", &harness);
}

#[test]
fn texts_stand_out_under_the_pointer() {
    let mut seen = 0;
    for keys in [&[][..], &[(Modifiers::NONE, Key::J)], &[(Modifiers::NONE, Key::T)]] {
        let mut harness = shown(Settings::default(), keys);
        let screen = harness.ctx.content_rect();
        let nodes = harness.root().children_recursive();
        let controls = nodes.filter(|node| {
            let node = node.accesskit_node();
            egui::accessibility::is_input(node.role()) && node.bounding_box().is_some()
        });
        let places: Vec<Pos2> = controls.map(|node| node.rect().center()).collect();
        for at in places.into_iter().filter(|at| screen.contains(*at)) {
            harness.event(Event::PointerMoved(at));
            harness.run_steps(3);
            assert_strong(&format!("under the pointer at {at:?}"), &harness);
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen}");
}

#[test]
fn the_measure_knows_weak_text() {
    assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-3);
    // A pair of the standard's notes: mid grey on white is 4.48.
    let grey = contrast(Color32::from_gray(0x77), Color32::WHITE);
    assert!((grey - 4.48).abs() < 0.01, "{grey}");
}
