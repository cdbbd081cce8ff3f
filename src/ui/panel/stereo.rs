//! Both eyes of a picture in stereo.

use egui::Ui;

use super::Context;
use crate::{
    scene::{StereoLayout, param},
    ui::widgets::{choice, param_slider},
};

/// How both pictures are put together, and the viewer's three lengths.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let stereo = &mut cx.scene.camera.stereo;
    choice(
        ui,
        "Stereo",
        &mut stereo.layout,
        &[
            (StereoLayout::Off, "Off", "One picture"),
            (StereoLayout::SideBySide, "Side by side", "A picture for each eye, beside each other"),
            (StereoLayout::TopBottom, "Stacked", "A picture for each eye, the left one's above"),
            (
                StereoLayout::Anaglyph,
                "Red-cyan",
                "One picture for glasses with a red left and a cyan right glass",
            ),
        ],
    );
    if stereo.is_on() {
        param_slider(ui, &param::SCREEN_HEIGHT, &mut stereo.screen_height_cm);
        param_slider(ui, &param::EYE_DISTANCE, &mut stereo.eye_distance_cm);
        param_slider(ui, &param::EYE_SEPARATION, &mut stereo.eye_separation_cm);
        ui.checkbox(&mut stereo.swap_eyes, "Swap eyes").on_hover_text(
            "Each eye's picture in the place of the other, to be looked at cross-eyed",
        );
    }
}
