//! Every text of the interface stands out from what is behind it.

use std::collections::BTreeMap;

use egui::{Color32, Pos2, Rgba, Shape, epaint::TextShape};
use egui_kittest::Harness;
use mandelight::{
    scene::{Scene, presets},
    ui::{GalleryState, Notice, Settings, theme},
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

/// The colour at `at` after `shapes`; none where a picture or a gradient lies there.
fn behind(shapes: &[&Shape], at: Pos2) -> Option<Color32> {
    // Under the first shape lies the page's background.
    let mut color = Some(theme::BACKGROUND);
    for shape in shapes {
        match shape {
            Shape::Rect(rect) if rect.rect.contains(at) => {
                let is_picture = rect.brush.is_some();
                color = color.filter(|_| !is_picture).map(|under| under.blend(rect.fill));
                if rect.fill.a() == 255 && !is_picture {
                    color = Some(rect.fill);
                }
            }
            Shape::Circle(circle) if circle.center.distance(at) < circle.radius => {
                color = color.map(|under| under.blend(circle.fill));
            }
            Shape::Mesh(mesh) if mesh.calc_bounds().contains(at) => color = None,
            _ => {}
        }
    }
    color
}

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
        let Some(ground) = behind(&shapes[..index], rect.center()) else { continue };
        count += 1;
        let smallest = text.galley.job.sections.iter().map(|part| part.format.font_id.size);
        assert!(smallest.fold(f32::MAX, f32::min) >= LEAST_SIZE, "{words} is too small");
        let ratio = contrast(ground.blend(color_of(text)), ground);
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

#[test]
fn the_measure_knows_weak_text() {
    assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-3);
    // A pair of the standard's notes: mid grey on white is 4.48.
    let grey = contrast(Color32::from_gray(0x77), Color32::WHITE);
    assert!((grey - 4.48).abs() < 0.01, "{grey}");
}
