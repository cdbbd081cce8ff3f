//! The camera panel.

use egui::{RichText, Ui};

use super::{
    context::{Context, Section},
    stereo,
};
use crate::{
    scene::{Camera, Scene, param},
    ui::{
        shortcuts::Command,
        status::{zoom, zoom_text},
        theme,
        widgets::{Help as _, button_row, param_slider, param_slider_count},
    },
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "camera",
    title: "Camera",
    hover: "Field of view, depth of field, stereo, fly mode",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the lens and the field of view of a new scene; the view stays where it is.
fn reset(scene: &mut Scene) {
    let Camera { vertical_fov_deg, lens, stereo, .. } = Camera::default();
    scene.camera = Camera { vertical_fov_deg, lens, stereo, ..scene.camera.clone() };
}

/// Field of view, lens, stereo, home, frame all, fly mode, and the eye's position.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    // In stereo, the screen's height and distance determine the field of view.
    if !cx.scene.camera.stereo.is_on() {
        param_slider(ui, &param::VERTICAL_FOV, &mut cx.scene.camera.vertical_fov_deg);
    }
    lens(ui, cx);
    stereo::show(ui, cx);
    let buttons = [
        (
            "Home",
            "Fly back to the scene's first view; from a deep one, out to the whole fractal (H)",
            Command::Home,
        ),
        ("Frame all", "Show the whole fractal from this side (A)", Command::FrameAll),
        (
            "Fly",
            "Fly by keys, which the view names, or with two fingers; a drag looks around (F)",
            Command::ToggleFlight,
        ),
    ];
    button_row(ui, buttons.len(), |ui, index, size| {
        let (name, hover, command) = buttons[index];
        let chosen = command == Command::ToggleFlight && cx.flying;
        let button = egui::Button::selectable(chosen, name).fill(if chosen {
            ui.visuals().selection.bg_fill
        } else {
            theme::RAISED
        });
        if ui.add_sized(size, button.truncate()).help(hover).clicked() {
            cx.commands.push(command);
        }
    });
    let camera = &cx.scene.camera;
    let mut line = |name: &str, value: String, hover: &str| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(name).small().color(theme::TEXT_DIM));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add(egui::Label::new(RichText::new(value).small()).truncate());
            });
        })
        .response
        .help(hover);
    };
    let eye = camera.position.to_dvec3();
    line(
        "Eye",
        format!("{:.5}, {:.5}, {:.5}", eye.x, eye.y, eye.z),
        "The eye's position in scene units: x, y, z",
    );
    line("Zoom", zoom_text(zoom(camera)), "The magnification, compared with a new scene");
    if let Some(camera_status) = cx.camera_status {
        line(
            "To the surface",
            format!("{} units", significant(camera_status.distance)),
            "The eye's estimated distance to the nearest surface, in scene units. You fly slower when it is small.",
        );
    }
}

/// Depth of field: aperture and focus.
fn lens(ui: &mut Ui, cx: &mut Context<'_>) {
    let lens = &mut cx.scene.camera.lens;
    ui.checkbox(&mut lens.depth_of_field, "Depth of field")
        .help("Blurs what is nearer or farther than the focus, while the picture refines");
    if !lens.depth_of_field {
        return;
    }
    param_slider(ui, &param::F_NUMBER, &mut lens.f_number);
    param_slider(ui, &param::FOCUS, &mut lens.focus);
    param_slider_count(ui, &param::BLADES, &mut lens.blades);
    let hover = "Makes the surface in the middle of the picture sharp. Alt + click or O: the point under the pointer.";
    if ui.button("Focus on the middle").help(hover).clicked() {
        cx.commands.push(Command::Focus);
    }
}

fn significant(value: f64) -> String {
    if (1e-3..1e4).contains(&value) { format!("{value:.4}") } else { format!("{value:.2e}") }
}
