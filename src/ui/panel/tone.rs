//! How radiance becomes display values, and what lies behind the fractal.

use egui::Ui;

use super::Context;
use crate::{
    scene::{Tone, ToneChannels, ToneCurve, ToneMean, param},
    ui::{
        theme,
        widgets::{choice, color, param_slider},
    },
};

/// Exposure, the tone curve, the background's two colours.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let tone = &mut cx.scene.tone;
    exposure(ui, tone);
    curve(ui, tone);
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

/// How bright the picture is before the curve.
fn exposure(ui: &mut Ui, tone: &mut Tone) {
    ui.checkbox(&mut tone.auto_exposure, "Auto exposure")
        .on_hover_text("Brings the picture's mean to the key, then adds the exposure set below.");
    if tone.auto_exposure {
        choice(
            ui,
            "Mean",
            &mut tone.mean,
            &[
                (
                    ToneMean::Logarithmic,
                    "Logarithmic",
                    "The mean as the eye sees it: a few bright spots weigh little",
                ),
                (ToneMean::Arithmetic, "Arithmetic", "The luminance of the mean colour"),
            ],
        );
        param_slider(ui, &param::KEY, &mut tone.key);
    }
}

/// The curve, and what Reinhard's takes.
fn curve(ui: &mut Ui, tone: &mut Tone) {
    choice(
        ui,
        "Tone curve",
        &mut tone.curve,
        &[
            (ToneCurve::Reinhard, "Reinhard", "Rolls highlights off smoothly"),
            (ToneCurve::Aces, "ACES", "Film's contrast: dark shadows, bright colours go to white"),
            (ToneCurve::Agx, "AgX", "Soft contrast over many stops; bright colours fade early"),
            (
                ToneCurve::KhronosNeutral,
                "Neutral",
                "Khronos PBR Neutral: colours stay as they are below the highlights",
            ),
            (ToneCurve::Linear, "Linear", "None: what is brighter than 1 is cut off"),
        ],
    );
    if tone.curve == ToneCurve::Reinhard {
        choice(
            ui,
            "Reinhard on",
            &mut tone.channels,
            &[
                (ToneChannels::Luminance, "Luminance", "Colours keep their saturation"),
                (ToneChannels::PerChannel, "Each channel", "Bright colours go toward white"),
            ],
        );
        param_slider(ui, &param::WHITE_POINT, &mut tone.white_point);
    }
}
