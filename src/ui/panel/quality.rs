//! How much work a picture is given.

use egui::Ui;

use super::Context;
use crate::{
    scene::{Normals, param},
    ui::widgets::{choice, param_slider, param_slider_count},
};

/// Samples, detail, motion budget, normals, shadows.
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
}
