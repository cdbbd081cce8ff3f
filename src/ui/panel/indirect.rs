//! Light that reaches a surface by way of others.

use egui::Ui;

use super::Context;
use crate::{
    scene::{IndirectKind, param},
    ui::widgets::{choice, param_slider, param_slider_count},
};

/// Which operator, how far it looks, how much of it is added, how finely it samples.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let indirect = &mut cx.scene.indirect;
    choice(
        ui,
        "Indirect light",
        &mut indirect.kind,
        &[
            (IndirectKind::Off, "Off", "Only light that comes straight from its source"),
            (
                IndirectKind::Uniform,
                "Uniform",
                "Light from all around on the screen, most from what faces the same way",
            ),
            (
                IndirectKind::Horizon,
                "Horizon",
                "Crevices darken, and take the colour of what encloses them",
            ),
        ],
    );
    if indirect.kind == IndirectKind::Off {
        return;
    }
    param_slider(ui, &param::INDIRECT_RADIUS, &mut indirect.radius);
    param_slider(ui, &param::INDIRECT_STRENGTH, &mut indirect.strength);
    if indirect.kind == IndirectKind::Horizon {
        param_slider(ui, &param::INDIRECT_AMBIENT, &mut indirect.ambient);
        param_slider_count(ui, &param::INDIRECT_DIRECTIONS, &mut indirect.directions);
    }
    param_slider_count(ui, &param::INDIRECT_SAMPLES, &mut indirect.samples);
}
