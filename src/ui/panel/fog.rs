//! The fog panel.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{Fog, Scene, param},
    ui::widgets::{Help as _, color, param_slider},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "fog",
    title: "Fog",
    hover: "Haze between you and the fractal; with path tracing also shafts of light",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the settings of a new scene.
fn reset(scene: &mut Scene) {
    scene.fog = Fog::default();
}

/// Density; for fog that is there, its colour, direction, height and size.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let fog = &mut cx.scene.fog;
    param_slider(ui, &param::FOG_DENSITY, &mut fog.density);
    if fog.density <= 0.0 {
        return;
    }
    color(ui, "Fog colour", "Colour of the fog in white light", &mut fog.color);
    param_slider(ui, &param::FOG_ANISOTROPY, &mut fog.anisotropy);
    let mut is_low = fog.height.is_some();
    let hover = "Thick below, thin above. Off: the same everywhere.";
    if ui.checkbox(&mut is_low, "Ground fog").help(hover).changed() {
        fog.height = is_low.then_some(param::FOG_HEIGHT.default);
    }
    if let Some(height) = &mut fog.height {
        param_slider(ui, &param::FOG_HEIGHT, height);
        param_slider(ui, &param::FOG_LEVEL, &mut fog.level);
    }
    param_slider(ui, &param::FOG_RADIUS, &mut fog.radius);
}
