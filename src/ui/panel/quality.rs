//! How much work a picture is given.

use egui::Ui;

use super::Context;
use crate::{
    scene::param,
    ui::widgets::{param_slider, param_slider_count},
};

/// Motion budget, samples, detail, shadows.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let quality = &mut cx.scene.quality;
    param_slider_count(ui, &param::SAMPLES, &mut quality.samples);
    param_slider(ui, &param::DETAIL, &mut quality.detail);
    param_slider(ui, &param::MOTION_BUDGET, &mut quality.motion_budget_ms);
    ui.checkbox(&mut quality.shadows, "Shadows").on_hover_text(
        "Whether any light casts shadows. Off is faster; each light keeps its own setting.",
    );
}
