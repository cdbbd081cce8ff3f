//! The stereo panel.

use egui::Ui;

use super::context::Context;
use crate::{
    scene::{StereoLayout, param},
    ui::widgets::{Help as _, choice, param_slider},
};

/// The layout of both pictures, and the viewer's three lengths.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let stereo = &mut cx.scene.camera.stereo;
    choice(
        ui,
        "Stereo",
        &mut stereo.layout,
        &[
            (StereoLayout::Off, "Off", "One picture, without 3D"),
            (StereoLayout::SideBySide, "Side by side", "The left eye's picture on the left"),
            (StereoLayout::TopBottom, "Stacked", "The left eye's picture on top"),
            (StereoLayout::Anaglyph, "Red-cyan", "3D with red-cyan glasses, red on the left eye"),
        ],
    );
    if stereo.is_on() {
        param_slider(ui, &param::SCREEN_HEIGHT, &mut stereo.screen_height_cm);
        param_slider(ui, &param::EYE_DISTANCE, &mut stereo.eye_distance_cm);
        param_slider(ui, &param::EYE_SEPARATION, &mut stereo.eye_separation_cm);
        ui.checkbox(&mut stereo.swap_eyes, "Swap eyes")
            .help("Exchanges the pictures of both eyes, for cross-eyed viewing");
    }
}
