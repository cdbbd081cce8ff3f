//! The quality panel.

use egui::{RichText, Ui};

use super::context::{Context, Section};
use crate::{
    render::report::mebibytes,
    scene::{Normals, Quality, Scene, param},
    ui::{
        theme,
        widgets::{Help as _, choice, param_slider, param_slider_count},
    },
};

/// The GPU memory of the view, with each purpose in the hover text.
fn memory(ui: &mut Ui, cx: &Context<'_>) {
    let memory = cx.inputs.report.memory;
    let text = format!("GPU memory: {}", mebibytes(memory.total()));
    let label = ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
    label.live_help(|| {
        let line = |name: &str, bytes: u64| format!("{name}: {}", mebibytes(bytes));
        let purposes = memory.purposes().into_iter().filter(|(_, bytes)| *bytes > 0);
        let mut lines: Vec<String> = purposes.map(|(name, bytes)| line(name, bytes)).collect();
        lines.push("In addition:".to_owned());
        let window = ui.ctx().content_rect().size() * ui.ctx().pixels_per_point();
        // The window has two buffers of 4 bytes per pixel.
        let buffers = 8 * (window.x * window.y) as u64;
        lines.push(line("the window's buffers, about", buffers));
        let textures = ui.ctx().tex_manager();
        let interface: usize = textures.read().allocated().map(|(_, meta)| meta.bytes_used()).sum();
        lines.push(line("the interface's textures", interface as u64));
        let small = cx.inputs.small_pictures.memory_bytes;
        if small > 0 {
            lines.push(line("small pictures", small));
        }
        lines.join("\n")
    });
}

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "quality",
    title: "Quality",
    hover: "Trade sharpness for speed",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the settings of a new scene.
fn reset(scene: &mut Scene) {
    scene.quality = Quality::default();
}

/// Samples, detail, motion budget, normals, shadows, memory.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let quality = &mut cx.scene.quality;
    param_slider_count(ui, &param::SAMPLES, &mut quality.samples);
    param_slider(ui, &param::DETAIL, &mut quality.detail);
    param_slider(ui, &param::MOTION_BUDGET, &mut quality.motion_budget_ms);
    choice(
        ui,
        "Surface shading",
        &mut quality.normals,
        &[
            (Normals::None, "Flat", "No shading: lit points are equally bright"),
            (Normals::Three, "Coarse", "From 3 neighbours: fast, and wrong on most sides"),
            (Normals::Six, "Standard", "From 6 neighbours: two along each axis"),
            (Normals::Eighteen, "Soft", "From 18 neighbours: slow, soft"),
            (Normals::TwentySix, "Softest", "From 26 neighbours: slowest, softest"),
            (Normals::Analytic, "Exact", "From the formula: sharpest, and fast"),
        ],
    );
    ui.checkbox(&mut quality.shadows, "Shadows")
        .help("Shadows of all lights. Off is faster; each light keeps its own setting.");
    memory(ui, cx);
}
