//! How much work a picture is given.

use egui::{RichText, Ui};

use super::Context;
use crate::{
    render::report::mebibytes,
    scene::{Normals, param},
    ui::{
        theme,
        widgets::{choice, param_slider, param_slider_count},
    },
};

/// What the picture holds of the GPU's memory, with each purpose in the hover text.
fn memory(ui: &mut Ui, cx: &Context<'_>) {
    let memory = cx.inputs.report.memory;
    let text = format!("GPU memory: {}", mebibytes(memory.total()));
    let label = ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
    label.on_hover_ui(|ui| {
        let line = |ui: &mut Ui, name: &str, bytes: u64| {
            ui.label(RichText::new(format!("{name}: {}", mebibytes(bytes))).small());
        };
        for (purpose, bytes) in memory.purposes().into_iter().filter(|(_, bytes)| *bytes > 0) {
            line(ui, purpose, bytes);
        }
        ui.label(RichText::new("Not counted in it:").small());
        let window = ui.ctx().content_rect().size() * ui.ctx().pixels_per_point();
        // Two pictures of four bytes a pixel: one is shown, one is drawn.
        line(ui, "the window's own pictures, about", 8 * (window.x * window.y) as u64);
        let textures = ui.ctx().tex_manager();
        let interface: usize = textures.read().allocated().map(|(_, meta)| meta.bytes_used()).sum();
        line(ui, "the interface's textures", interface as u64);
    });
}

/// Samples, detail, motion budget, normals, shadows, memory.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let quality = &mut cx.scene.quality;
    param_slider_count(ui, &param::SAMPLES, &mut quality.samples);
    param_slider(ui, &param::DETAIL, &mut quality.detail);
    param_slider(ui, &param::MOTION_BUDGET, &mut quality.motion_budget_ms);
    choice(
        ui,
        "Normals",
        &mut quality.normals,
        &[
            (Normals::None, "None", "Light as if every point faced it: shows what it could reach"),
            (Normals::Three, "3", "One neighbour along each axis: fast, and wrong on most sides"),
            (Normals::Six, "6", "Two neighbours along each axis"),
            (Normals::Eighteen, "18", "Neighbours along axes and their diagonals: slow, soft"),
            (Normals::TwentySix, "26", "All neighbours of a cube: slowest, softest"),
            (Normals::Analytic, "Exact", "The distance's own gradient: sharpest, and fast"),
        ],
    );
    ui.checkbox(&mut quality.shadows, "Shadows").on_hover_text(
        "Whether any light casts shadows. Off is faster; each light keeps its own setting.",
    );
    memory(ui, cx);
}
