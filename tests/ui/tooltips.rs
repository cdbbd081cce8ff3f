//! A hover text covers no control but its own.

use egui::{Event, Key, Modifiers, Order, Rect, accesskit::Role};
use egui_kittest::{Harness, kittest::NodeT as _};
use mandelight::{
    formula::{self, Fractal},
    scene::{Scene, document, presets},
    ui::{Settings, thumbnail},
};

use crate::stage::*;

/// Frames until a hover text has its place.
const FRAMES: usize = 8;
/// Part of the screen from which on a control is the ground of others, such as the picture.
const GROUND_PART: f32 = 0.2;

/// The controls that are in sight, by name.
fn controls(harness: &Harness<'_, Stage>) -> Vec<(String, Rect)> {
    let screen = harness.ctx.content_rect();
    let rects = harness.state().interface.rects();
    let panel = rects.get("panel").unwrap_or(screen);
    // The part of the panel that scrolls begins below its heading.
    let heading = rects.get("panel toggle").map_or(panel.top(), |toggle| toggle.bottom());
    let nodes = harness.root().children_recursive();
    let nodes = nodes.filter(|node| {
        let node = node.accesskit_node();
        let is_control =
            egui::accessibility::is_input(node.role()) && node.role() != Role::Splitter;
        is_control && node.bounding_box().is_some()
    });
    let controls =
        nodes.map(|node| (node.accesskit_node().label().unwrap_or_default(), node.rect()));
    controls
        .filter(|(_, rect)| screen.contains_rect(*rect))
        .filter(|(_, rect)| rect.area() < GROUND_PART * screen.area())
        .filter(|(name, rect)| {
            let is_in_panel = panel.contains(rect.center());
            !is_in_panel
                || name == "Hide panel"
                || rect.top() >= heading
                || rect.bottom() <= heading
        })
        .collect()
}

fn tooltips(harness: &Harness<'_, Stage>) -> Vec<Rect> {
    harness.ctx.memory(|memory| {
        let layers = memory.areas().visible_layer_ids();
        let tooltips = layers.into_iter().filter(|layer| layer.order == Order::Tooltip);
        tooltips.filter_map(|layer| memory.area_rect(layer.id)).collect()
    })
}

/// Hovers each control in sight; returns what hover texts cover, and the number of hover texts.
fn covered(harness: &mut Harness<'_, Stage>) -> (Vec<String>, usize) {
    harness.ctx.all_styles_mut(|style| {
        style.interaction.tooltip_delay = 0.0;
        style.interaction.show_tooltips_only_when_still = false;
    });
    let (mut covered, mut count) = (Vec::new(), 0);
    for (name, rect) in controls(harness) {
        // Away, so that the text before is gone.
        harness.event(Event::PointerGone);
        harness.run_steps(2);
        harness.event(Event::PointerMoved(rect.center()));
        harness.run_steps(FRAMES);
        for tooltip in tooltips(harness) {
            count += 1;
            for (other, under) in controls(harness) {
                let both = under.intersect(tooltip);
                let is_other = under != rect && !under.contains_rect(rect);
                if is_other && both.width() > 1.0 && both.height() > 1.0 {
                    covered.push(format!("the text of {name:?} at {tooltip:?} covers {other:?}"));
                }
            }
        }
    }
    (covered, count)
}

#[test]
fn hover_texts_cover_no_other_control() {
    let (mut all, mut count) = (Vec::new(), 0);
    let mut look = |what: &str, harness: &mut Harness<'_, Stage>| {
        let (covered, seen) = covered(harness);
        all.extend(covered.into_iter().map(|covered| format!("{what}: {covered}")));
        count += seen;
    };
    let open = |settings: Settings, keys: &[(Modifiers, Key)]| {
        let mut harness = without_motion(stage(presets::opening(), settings, [1280.0, 720.0]));
        for &(modifiers, key) in keys {
            harness.key_press_modifiers(modifiers, key);
            harness.run_steps(14);
        }
        harness
    };
    const NONE: Modifiers = Modifiers::NONE;
    look("the panel", &mut open(Settings::default(), &[]));
    look("the timeline", &mut open(Settings::default(), &[(NONE, Key::T), (NONE, Key::K)]));
    look("sharing", &mut open(Settings::default(), &[(NONE, Key::J)]));
    look("help", &mut open(Settings::default(), &[(NONE, Key::F1)]));
    look("variations", &mut open(Settings::default(), &[(NONE, Key::M)]));
    look("comparing", &mut open(Settings::default(), &[(Modifiers::SHIFT, Key::C)]));
    let mut harness = without_motion(stage(Scene::default(), unfolded(), [1280.0, 2000.0]));
    look("many options", &mut harness);
    assert!(count > 150, "{count} hover texts");
    assert!(all.is_empty(), "{} are covered: {all:#?}", all.len());
}

#[test]
fn hover_texts_of_low_windows_and_of_lists_cover_no_other_control() {
    let (mut all, mut count) = (Vec::new(), 0);
    let mut look = |what: &str, harness: &mut Harness<'_, Stage>| {
        let (covered, seen) = covered(harness);
        all.extend(covered.into_iter().map(|covered| format!("{what}: {covered}")));
        count += seen;
    };
    for size in [[1280.0, 720.0], [640.0, 420.0]] {
        let open = |scene: Scene, settings: Settings| without_motion(stage(scene, settings, size));
        let mut harness = open(presets::opening(), Settings::default());
        look(&format!("the panel in {size:?}"), &mut harness);

        harness.key_press_modifiers(Modifiers::COMMAND, Key::K);
        harness.run_steps(4);
        // A long list of results would fill the low window.
        harness.event(Event::Text("porcelain".to_owned()));
        harness.run_steps(4);
        look(&format!("the finder in {size:?}"), &mut harness);

        let mut harness = open(presets::opening(), Settings::default());
        let kept = document::project_to_json_compact(harness.state().interface.project());
        let jpeg = thumbnail::jpeg(&presets::opening_scenes()[0]).expect("a picture");
        harness.state_mut().interface.keep_favourite(kept, jpeg.to_vec());
        press(&mut harness, "Mine");
        look(&format!("kept views in {size:?}"), &mut harness);

        let fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
        let mut settings = Settings { more_open: true, ..Settings::default() };
        settings.sections.set_open("fractal", true);
        let mut harness = open(Scene { fractal, ..Scene::default() }, settings);
        button(&harness, "Edit the formula…").click_accesskit();
        harness.run_steps(14);
        look(&format!("the formula editor in {size:?}"), &mut harness);
    }
    assert!(count > 150, "{count} hover texts");
    assert!(all.is_empty(), "{} are covered: {all:#?}", all.len());
}
