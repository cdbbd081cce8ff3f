//! The status line: a bar while a picture is in progress.

use egui::{Color32, Rect, Shape};
use egui_kittest::Harness;
use mandelight::{
    render::report::Activity,
    scene::Scene,
    ui::{Settings, theme},
};

use crate::stage::*;

/// The filled rectangles of a colour in the status line.
fn bars(harness: &Harness<'_, Stage>, color: Color32) -> Vec<Rect> {
    let line = harness.state().interface.rects().get("status").expect("the status line");
    let bars = shapes(harness).into_iter().filter_map(|shape| match shape {
        Shape::Rect(rect) if rect.fill == color && line.contains_rect(rect.rect) => Some(rect.rect),
        _ => None,
    });
    bars.collect()
}

#[test]
fn a_bar_grows_while_a_picture_is_in_progress() {
    for size in [[1280.0, 720.0], [390.0, 844.0]] {
        let mut harness = stage(Scene::default(), Settings::default(), size);
        let mut last_width = 0.0;
        for samples in [4, 8, 12] {
            let report = &mut harness.state_mut().report;
            (report.samples_done, report.samples_so_far) = (samples, samples as f32);
            harness.run();
            let [done] = bars(&harness, theme::ACCENT)[..] else { panic!("no bar in {size:?}") };
            let whole = bars(&harness, theme::LINE);
            let whole = whole.iter().find(|whole| whole.expand(0.1).contains_rect(done));
            let whole = whole.expect("the whole bar");
            let part = done.width() / whole.width();
            assert!((part - samples as f32 / 16.0).abs() < 0.01, "{part} after {samples} of 16");
            assert!(done.width() > last_width);
            last_width = done.width();
        }
        for activity in [Activity::Idle, Activity::Moving] {
            harness.state_mut().report.activity = activity;
            harness.run();
            assert!(bars(&harness, theme::ACCENT).is_empty(), "in {size:?}");
        }
    }
}
