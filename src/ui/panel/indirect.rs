//! The indirect light panel.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{IndirectKind, param},
    ui::widgets::{choice, param_slider, param_slider_count},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "indirect",
    title: "Indirect light",
    hover: "Light that bounces from one surface to another",
    show,
};

/// The operator, its radius, strength and sampling.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let indirect = &mut cx.scene.indirect;
    choice(
        ui,
        "Indirect light",
        &mut indirect.kind,
        &[
            (IndirectKind::Off, "Off", "Only light directly from the lights"),
            (
                IndirectKind::Uniform,
                "Uniform",
                "Adds light from nearby surfaces, mostly those that face the same way",
            ),
            (
                IndirectKind::Horizon,
                "Horizon",
                "Darkens crevices and adds the colours of the surfaces around them",
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
