//! The surface panel: the material.

use egui::Ui;

use super::context::{Context, Section};
use crate::{
    scene::{Medium, MediumKind, Scene, Surface, SurfaceModel, param},
    ui::widgets::{Help as _, choice, color, param_slider},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "surface",
    title: "Surface",
    hover: "How the surface looks: matte, glossy, metallic or glowing",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the surface of a new scene; its colours stay.
fn reset(scene: &mut Scene) {
    let Surface { coloring, gradient, second_layer, .. } = scene.surface.clone();
    scene.surface = Surface { coloring, gradient, second_layer, ..Surface::default() };
    scene.medium = Medium::default();
}

/// What the set is made of: surface models, and media.
#[derive(Clone, Copy, PartialEq)]
enum Material {
    Surface(SurfaceModel),
    Medium(MediumKind),
}

impl Material {
    fn of(scene: &Scene) -> Self {
        match scene.medium.kind {
            MediumKind::None => Self::Surface(scene.surface.model),
            kind => Self::Medium(kind),
        }
    }

    fn set(self, scene: &mut Scene) {
        match self {
            Self::Surface(model) => {
                (scene.medium.kind, scene.surface.model) = (MediumKind::None, model);
            }
            Self::Medium(kind) => scene.medium.kind = kind,
        }
    }
}

/// The material; a surface's reflectance and emission, or a medium.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let mut material = Material::of(cx.scene);
    choice(
        ui,
        "Material",
        &mut material,
        &[
            (
                Material::Surface(SurfaceModel::BlinnPhong),
                "Classic",
                "Matte, with round highlights of the lights",
            ),
            (
                Material::Surface(SurfaceModel::Physical),
                "Physical",
                "Stone, plastic, metal or varnish. With path tracing, reflections show the surroundings.",
            ),
            (
                Material::Medium(MediumKind::Set),
                "Translucent",
                "Light shines through, as through wax or jade. Needs path tracing.",
            ),
            (
                Material::Medium(MediumKind::Iterations),
                "Cloud",
                "Soft clouds around the fractal. Needs path tracing.",
            ),
        ],
    );
    if material != Material::of(cx.scene) {
        material.set(cx.scene);
    }
    match material {
        Material::Surface(model) => of_surface(ui, &mut cx.scene.surface, model),
        Material::Medium(kind) => of_medium(ui, cx.scene, kind),
    }
}

fn of_surface(ui: &mut Ui, surface: &mut Surface, model: SurfaceModel) {
    match model {
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

fn of_medium(ui: &mut Ui, scene: &mut Scene, kind: MediumKind) {
    if !scene.traces_paths() {
        let hover = "Draws the light inside once the picture stops moving; until then only the surface shows";
        if ui.button("Turn on path tracing").help(hover).clicked() {
            scene.trace_paths();
        }
    }
    let medium = &mut scene.medium;
    color(
        ui,
        "Inner colour",
        "Colour of the light that is scattered inside. Repeated scattering makes it stronger: choose pale colours.",
        &mut medium.color,
    );
    param_slider(ui, &param::MEAN_FREE_PATH, &mut medium.mean_free_path);
    param_slider(ui, &param::MEDIUM_ANISOTROPY, &mut medium.anisotropy);
    if kind == MediumKind::Iterations {
        param_slider(ui, &param::THIN_ITERATIONS, &mut medium.thin_iterations);
        param_slider(ui, &param::DENSE_ITERATIONS, &mut medium.dense_iterations);
    }
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
    ui.label("Vary by the second colour layer").help(
        "Multiplies each value by the brightness of the second layer's gradient: white keeps the slider's value, black makes it 0. Set up the layer under Colours. Amount 0 hides its colours.",
    );
    ui.horizontal_wrapped(|ui| {
        if is_physical {
            ui.checkbox(&mut driven.roughness, "Roughness by layer")
                .help("Dark parts of the layer's gradient are smooth, bright ones rough");
            ui.checkbox(&mut driven.metalness, "Metalness by layer")
                .help("Bright parts of the layer's gradient are metal, if Metalness is above 0");
            ui.checkbox(&mut driven.coat, "Coat by layer")
                .help("Bright parts of the layer's gradient have the coat, if Clear coat is above 0");
        }
        ui.checkbox(&mut driven.emission, "Emission by layer").help(
            "The surface glows in the colours of the layer's gradient, if Emission is above 0; black does not glow",
        );
    });
}
