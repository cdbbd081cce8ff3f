//! How radiance becomes display values, and what lies behind the fractal.

use egui::Ui;

use super::Context;
use crate::{
    scene::{ToneCurve, param},
    ui::{
        theme,
        widgets::{choice, color, param_slider},
    },
};

/// The tone curve, its white point, the background's two colours.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let tone = &mut cx.scene.tone;
    choice(
        ui,
        "Tone curve",
        &mut tone.curve,
        &[
            (
                ToneCurve::ReinhardLuminance,
                "Reinhard",
                "Rolls highlights off smoothly, by luminance",
            ),
            (ToneCurve::Linear, "Linear", "None: what is brighter than 1 is cut off"),
        ],
    );
    ui.add_enabled_ui(tone.curve == ToneCurve::ReinhardLuminance, |ui| {
        param_slider(ui, &param::WHITE_POINT, &mut tone.white_point);
    });
    let background = &mut cx.scene.background;
    ui.horizontal(|ui| {
        ui.label(egui::RichText::new("Background").color(theme::TEXT_DIM));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            color(
                ui,
                "Background bottom",
                "The colour at the picture's lower edge",
                &mut background.bottom,
            );
            color(
                ui,
                "Background top",
                "The colour at the picture's upper edge",
                &mut background.top,
            );
        });
    });
}
