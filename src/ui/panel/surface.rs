//! The surface panel: material, gradient and colouring.

use egui::{Button, Ui};

use super::context::{Context, Section};
use crate::{
    scene::{ColorSource, param},
    ui::widgets::{choice, color, gradient, move_stop, param_slider},
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "surface",
    title: "Surface",
    hover: "Highlights, brightness and colours of the surface",
    show,
};

/// Reflectance, the gradient, and the value that selects its colours.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let surface = &mut cx.scene.surface;
    param_slider(ui, &param::AMBIENT, &mut surface.ambient);
    param_slider(ui, &param::DIFFUSE, &mut surface.diffuse);
    param_slider(ui, &param::SPECULAR, &mut surface.specular);
    param_slider(ui, &param::SHININESS, &mut surface.shininess);

    choice(
        ui,
        "Colour by",
        &mut surface.coloring.source,
        &[
            (
                ColorSource::Iterations,
                "Steps",
                "Colours by the number of formula steps until a point escapes",
            ),
            (
                ColorSource::OriginTrap,
                "Origin",
                "Colours by how near a point's orbit comes to the centre (orbit trap)",
            ),
            (
                ColorSource::AxisTrap,
                "Axis",
                "Colours by how near a point's orbit comes to the z axis (orbit trap)",
            ),
            (
                ColorSource::PlaneTrap,
                "Plane",
                "Colours by how near a point's orbit comes to the plane z = 0 (orbit trap)",
            ),
        ],
    );
    ui.add_space(4.0);
    let bar = gradient(ui, &mut surface.gradient, &mut cx.selection.stop);
    cx.rects.record("gradient", &bar);
    stop(ui, cx);
    let coloring = &mut cx.scene.surface.coloring;
    ui.checkbox(&mut coloring.follows_view, "Follow the view").on_hover_text(
        "Spreads the whole gradient over what is in view, at any depth. Off: the colours of a place \
         stay the same wherever you look from",
    );
    param_slider(ui, &param::COLOR_REPEATS, &mut coloring.repeats);
    param_slider(ui, &param::COLOR_OFFSET, &mut coloring.offset);
}

/// The selected stop: position, colour and removal.
fn stop(ui: &mut Ui, cx: &mut Context<'_>) {
    let stops = &mut cx.scene.surface.gradient;
    let selected = &mut cx.selection.stop;
    *selected = (*selected).min(stops.len().saturating_sub(1));
    let Some(stop) = stops.get(*selected) else {
        return;
    };
    let mut position = stop.position;
    if param_slider(ui, &param::STOP_POSITION, &mut position).changed() {
        move_stop(stops, *selected, position);
    }
    ui.horizontal(|ui| {
        color(ui, "Stop colour", "The colour of the selected stop", &mut stops[*selected].color);
        ui.label(format!("Stop {} of {}", *selected + 1, stops.len()));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let removable = stops.len() > 1;
            let remove = ui
                .add_enabled(removable, Button::new("Remove stop"))
                .on_hover_text("Remove the selected stop")
                .on_disabled_hover_text("A gradient needs at least one stop.");
            if remove.clicked() {
                stops.remove(*selected);
                *selected = selected.saturating_sub(1);
            }
        });
    });
}
