//! The tone panel: histogram, exposure, tone curve and background.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{Background, Scene, Tone, ToneChannels, ToneCurve, ToneMean, param},
    ui::{
        theme,
        widgets::{DisplayRange, Help as _, choice, color, color_size, histogram, param_slider},
    },
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "tone",
    title: "Tone and background",
    hover: "Brightness, contrast and the background",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores tone and background of a new scene.
fn reset(scene: &mut Scene) {
    (scene.tone, scene.background) = (Tone::default(), Background::default());
}

/// The histogram, exposure, the tone curve, and the background's two colours.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    histogram_of(ui, cx);
    let tone = &mut cx.scene.tone;
    exposure(ui, tone);
    curve(ui, tone);
    let background = &mut cx.scene.background;
    ui.horizontal(|ui| {
        ui.label(egui::RichText::new("Background").color(theme::TEXT_DIM));
        // Added from left to right, which is the order of the Tab key.
        let buttons = 2.0 * color_size(ui).x + ui.spacing().item_spacing.x;
        ui.add_space((ui.available_width() - buttons).max(0.0));
        color(
            ui,
            "Background top",
            "The background's colour at the upper edge",
            &mut background.top,
        );
        color(
            ui,
            "Background bottom",
            "The background's colour at the lower edge",
            &mut background.bottom,
        );
    });
}

/// Linear value of the 8-bit code 1; smaller values display as black.
const BLACK: f64 = 1.0 / 255.0 / 12.92;

/// The film's histogram, with the range that the display can show.
fn histogram_of(ui: &mut Ui, cx: &mut Context<'_>) {
    let tone = &cx.scene.tone;
    let report = cx.inputs.report.histogram.as_ref();
    let adapted = report.filter(|_| tone.auto_exposure).map_or(0.0, |report| report.adapted_stops);
    let exposure = tone.exposure + f64::from(adapted);
    let stops = |exposed: f64| exposed.log2() - exposure;
    let range = DisplayRange { black: stops(BLACK), grey: stops(0.18), white: stops(tone.white()) };
    let response = histogram(ui, report, range);
    *cx.histogram_shown |= ui.is_rect_visible(response.rect);
    ui.add_space(4.0);
}

/// Auto exposure and its mean.
fn exposure(ui: &mut Ui, tone: &mut Tone) {
    ui.checkbox(&mut tone.auto_exposure, "Auto exposure")
        .help("Chooses the picture's brightness by itself. The exposure is added.");
    if tone.auto_exposure {
        choice(
            ui,
            "Measured by",
            &mut tone.mean,
            &[
                (
                    ToneMean::Logarithmic,
                    "Most of the picture",
                    "Small bright spots hardly change the brightness",
                ),
                (ToneMean::Arithmetic, "All light", "Small bright spots darken the picture"),
            ],
        );
        param_slider(ui, &param::KEY, &mut tone.key);
    }
}

/// The tone curve, and the settings of Reinhard's curve.
fn curve(ui: &mut Ui, tone: &mut Tone) {
    choice(
        ui,
        "Tone curve",
        &mut tone.curve,
        &[
            (ToneCurve::Reinhard, "Reinhard", "Compresses highlights smoothly"),
            (ToneCurve::Aces, "ACES", "High contrast like film; bright colours become white"),
            (ToneCurve::Agx, "AgX", "Low contrast; bright colours fade early"),
            (ToneCurve::KhronosNeutral, "Neutral", "Khronos PBR Neutral: only highlights change"),
            (ToneCurve::Linear, "Linear", "No curve: values above 1 become flat white"),
        ],
    );
    if tone.curve == ToneCurve::Reinhard {
        choice(
            ui,
            "Curve works on",
            &mut tone.channels,
            &[
                (ToneChannels::Luminance, "Brightness", "Colours keep their saturation"),
                (ToneChannels::PerChannel, "Each channel", "Bright colours become white"),
            ],
        );
        param_slider(ui, &param::WHITE_POINT, &mut tone.white_point);
    }
}
