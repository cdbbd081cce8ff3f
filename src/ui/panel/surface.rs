//! The surface panel: the material.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{Surface, SurfaceModel, param},
    ui::widgets::{choice, color, param_slider},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "surface",
    title: "Surface",
    hover: "How the surface looks: matte, glossy, metallic or glowing",
    show,
};

/// The model, its reflectance, emission.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let surface = &mut cx.scene.surface;
    choice(
        ui,
        "Material",
        &mut surface.model,
        &[
            (SurfaceModel::BlinnPhong, "Classic", "Matte, with round highlights of the lights"),
            (
                SurfaceModel::Physical,
                "Physical",
                "Stone, plastic, metal or varnish. With path tracing, reflections show the surroundings.",
            ),
        ],
    );
    match surface.model {
        SurfaceModel::BlinnPhong => {
            param_slider(ui, &param::DIFFUSE, &mut surface.diffuse);
            param_slider(ui, &param::SPECULAR, &mut surface.specular);
            param_slider(ui, &param::SHININESS, &mut surface.shininess);
        }
        SurfaceModel::Physical => physical(ui, surface),
    }
    param_slider(ui, &param::AMBIENT, &mut surface.ambient);
    param_slider(ui, &param::EMISSION, &mut surface.emission);
    driven_by_layer(ui, surface);
}

fn physical(ui: &mut Ui, surface: &mut Surface) {
    param_slider(ui, &param::ROUGHNESS, &mut surface.roughness);
    param_slider(ui, &param::METALNESS, &mut surface.metalness);
    color(
        ui,
        "Reflection colour",
        "Colour of reflections on parts that aren't metal. Dark grey suits stone and plastic; brighter is shinier.",
        &mut surface.specular_color,
    );
    param_slider(ui, &param::COAT, &mut surface.coat);
    param_slider(ui, &param::COAT_ROUGHNESS, &mut surface.coat_roughness);
}

/// The values that the second layer of colours drives.
fn driven_by_layer(ui: &mut Ui, surface: &mut Surface) {
    let is_physical = surface.model == SurfaceModel::Physical;
    let driven = &mut surface.driven_by_layer;
    ui.label("Vary by the second colour layer").on_hover_text(
        "Bright parts of the second layer's gradient raise these values, dark parts lower them. Set up the layer under Colours. Amount 0 hides its colours.",
    );
    ui.horizontal_wrapped(|ui| {
        if is_physical {
            ui.checkbox(&mut driven.roughness, "Roughness by layer")
                .on_hover_text("Dark parts of the layer's gradient are smooth, bright ones rough");
            ui.checkbox(&mut driven.metalness, "Metalness by layer")
                .on_hover_text("Bright parts of the layer's gradient are metal");
            ui.checkbox(&mut driven.coat, "Coat by layer")
                .on_hover_text("Bright parts of the layer's gradient have the clear coat");
        }
        ui.checkbox(&mut driven.emission, "Emission by layer").on_hover_text(
            "The surface emits the colours of the layer's gradient; black emits nothing",
        );
    });
}
