//! How radiance becomes display values, and what lies behind the fractal.

use egui::Ui;

use super::Context;
use crate::{
    scene::{Tone, ToneChannels, ToneCurve, ToneMean, param},
    ui::{
        theme,
        widgets::{Window, choice, color, histogram, param_slider},
    },
};

/// Exposure, the tone curve, the background's two colours.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    histogram_of(ui, cx);
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

/// The display's darkest step but one, linear: what is below shows as black.
const BLACK: f64 = 1.0 / 255.0 / 12.92;

/// The film's histogram, with the part that exposure and curve bring to the display.
fn histogram_of(ui: &mut Ui, cx: &mut Context<'_>) {
    let tone = &cx.scene.tone;
    let known = cx.inputs.report.histogram.as_ref();
    let automatic = known.filter(|_| tone.auto_exposure).map_or(0.0, |known| known.adapted_stops);
    let exposure = tone.exposure + f64::from(automatic);
    let stops = |exposed: f64| exposed.log2() - exposure;
    let window = Window { black: stops(BLACK), grey: stops(0.18), white: stops(tone.white()) };
    let drawn = histogram(ui, known, window);
    *cx.histogram_shown |= ui.is_rect_visible(drawn.rect);
    ui.add_space(4.0);
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
