//! The surface panel: the material.

use egui::Ui;

use super::context::{Context, Section};
use crate::{scene::param, ui::widgets::param_slider};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "surface",
    title: "Surface",
    hover: "Highlights and brightness of the surface",
    show,
};

/// Reflectance.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let surface = &mut cx.scene.surface;
    param_slider(ui, &param::AMBIENT, &mut surface.ambient);
    param_slider(ui, &param::DIFFUSE, &mut surface.diffuse);
    param_slider(ui, &param::SPECULAR, &mut surface.specular);
    param_slider(ui, &param::SHININESS, &mut surface.shininess);
}
