//! The colours panel: two layers, each with a value and the gradient that it selects from.

use egui::{Button, Id, Popup, PopupCloseBehavior, ScrollArea, Ui};

use super::context::{Context, Section};
use crate::{
    scene::{
        Axis, ColorSource, Coloring, GradientStop, MediumKind, Scene, SecondLayer, Surface,
        gradient::{NamedGradient, library},
        param::{self, Param},
    },
    ui::{
        action::Action,
        selection::LayerRef,
        widgets::{
            Help as _, caption, choice, color, gradient, gradient_card, move_stop, param_slider,
        },
    },
};

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "colors",
    title: "Colours",
    hover: "What colours the surface, and with which gradient",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the colours of a new scene.
fn reset(scene: &mut Scene) {
    let Surface { coloring, gradient, second_layer, .. } = Surface::default();
    scene.surface = Surface { coloring, gradient, second_layer, ..scene.surface.clone() };
}

/// Greatest height of the list of gradients, in points.
const LIST_HEIGHT: f32 = 340.0;
/// Width of the list of gradients, in points.
const LIST_WIDTH: f32 = 260.0;

/// Both layers.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    if cx.scene.medium.kind != MediumKind::None {
        ui.label("This material has one inner colour: see Surface.");
        return;
    }
    layer(ui, cx, LayerRef::First);
    ui.add_space(6.0);
    let second = &mut cx.scene.surface.second_layer;
    let mut is_on = second.is_on();
    let hover = "Blends a second gradient, selected by another value, over the first";
    if ui.checkbox(&mut is_on, "Second layer").help(hover).changed() {
        switch(ui, second, is_on);
    }
    if is_on && param_slider(ui, &param::SECOND_LAYER_AMOUNT, &mut second.amount).changed() {
        // Switched off by the checkbox only: the controls stay under the pointer.
        second.amount = second.amount.max(param::SECOND_LAYER_AMOUNT.step);
    }
    // A layer that drives values of the surface is in use without being visible.
    if is_on || cx.scene.surface.driven_by_layer.any() {
        ui.push_id("second layer", |ui| layer(ui, cx, LayerRef::Second));
    }
}

/// Switches the layer on, with the amount that it had before, or off.
///
/// A layer that was never used gets a value that differs from the first's default.
fn switch(ui: &Ui, second: &mut SecondLayer, is_on: bool) {
    let id = Id::unique("amount of the second layer");
    if is_on {
        if second.coloring == Coloring::default() {
            second.coloring.source = ColorSource::Normal;
        }
        second.amount = ui.data(|data| data.get_temp(id)).unwrap_or(0.5);
    } else {
        ui.data_mut(|data| data.insert_temp(id, second.amount));
        second.amount = 0.0;
    }
}

/// The controls of one layer.
fn layer(ui: &mut Ui, cx: &mut Context<'_>, which: LayerRef) {
    let channel = cx.scene.fractal.formula().channel();
    let (coloring, stops) = which.of(&mut cx.scene.surface);
    choice(ui, "Colour by", &mut coloring.source, &sources(channel));
    shape(ui, coloring);
    ui.add_space(4.0);
    let bar = gradient(ui, stops, cx.selection.stop_mut(which));
    if which == LayerRef::First {
        cx.rects.record("gradient", &bar);
    }
    stop(ui, cx, which);
    gradients(ui, cx, which);
    let (coloring, _) = which.of(&mut cx.scene.surface);
    ui.checkbox(&mut coloring.follows_view, "Follow the view").help(
        "Spreads the whole gradient over what is in view, at any depth. Off: the colours of a place \
         stay the same wherever you look from",
    );
    param_slider(ui, &param::COLOR_REPEATS, &mut coloring.repeats);
    param_slider(ui, &param::COLOR_OFFSET, &mut coloring.offset);
}

/// The choice of values; `channel` is the name of the formula's own.
fn sources(channel: Option<&'static str>) -> Vec<(ColorSource, &'static str, &'static str)> {
    let mut all = vec![
        (
            ColorSource::Iterations,
            "Iterations",
            "Colours by the number of iterations until a point escapes",
        ),
        (
            ColorSource::PointTrap,
            "Point",
            "Colours by how near a point's orbit comes to a centre (orbit trap)",
        ),
        (
            ColorSource::AxisTrap,
            "Line",
            "Colours by how near a point's orbit comes to a line (orbit trap)",
        ),
        (
            ColorSource::PlaneTrap,
            "Plane",
            "Colours by how near a point's orbit comes to a plane (orbit trap)",
        ),
        (
            ColorSource::SphereTrap,
            "Sphere",
            "Colours by how near a point's orbit comes to a sphere's surface (orbit trap)",
        ),
        (
            ColorSource::CubeTrap,
            "Cube",
            "Colours by how near a point's orbit comes to a cube's surface (orbit trap)",
        ),
        (ColorSource::Position, "Position", "Colours by the place along an axis"),
        (ColorSource::Normal, "Direction", "Colours by the direction in which the surface faces"),
    ];
    if let Some(channel) = channel {
        all.push((
            ColorSource::Channel,
            channel,
            "Colours by a number that the formula computes at each step, such as its folds",
        ));
    }
    all
}

/// Axis, centre and size, for values that have them.
fn shape(ui: &mut Ui, coloring: &mut Coloring) {
    if coloring.source.has_axis() {
        let options = [
            (Axis::X, "X", "Left to right"),
            (Axis::Y, "Y", "Front to back"),
            (Axis::Z, "Z", "Bottom to top"),
        ];
        choice(ui, "Axis", &mut coloring.axis, &options);
    }
    if coloring.source.has_size() {
        param_slider(ui, &param::TRAP_SIZE, &mut coloring.size);
    }
    if coloring.source.trap_shape().is_some() {
        let labels = ["Centre x", "Centre y", "Centre z"];
        for (label, x) in labels.into_iter().zip(&mut coloring.center) {
            let param = Param { label, ..param::TRAP_CENTER };
            ui.push_id(label, |ui| param_slider(ui, &param, x));
        }
    }
}

/// The selected stop: position, colour and removal.
fn stop(ui: &mut Ui, cx: &mut Context<'_>, which: LayerRef) {
    let (_, stops) = which.of(&mut cx.scene.surface);
    let selected = cx.selection.stop_mut(which);
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
                .help("Remove the selected stop")
                .disabled_help("A gradient needs at least one stop.");
            if remove.clicked() {
                stops.remove(*selected);
                *selected = selected.saturating_sub(1);
            }
        });
    });
}

/// A button that opens the list of gradients.
fn gradients(ui: &mut Ui, cx: &mut Context<'_>, which: LayerRef) {
    let button = ui
        .add_sized(
            [ui.available_width(), ui.spacing().interact_size.y],
            Button::new("Choose a gradient…"),
        )
        .help("Gradients that come with Mandelight, and those of your files: open a gradient file here");
    let popup = Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    popup.show(|ui| {
        ui.set_width(LIST_WIDTH);
        let hover =
            "Reads gradients of GIMP (.ggr, .gpl), Fractint (.map) and Ultra Fractal (.ugr)";
        if ui.button("Open a gradient file…").help(hover).clicked() {
            cx.selection.gradient_target = which;
            cx.actions.push(Action::ChooseGradient);
            ui.close();
        }
        ScrollArea::vertical().max_height(LIST_HEIGHT).show(ui, |ui| {
            let (_, stops) = which.of(&mut cx.scene.surface);
            if !cx.gradients.is_empty() {
                caption(ui, "From your file");
                cards(ui, cx.gradients.iter().cloned(), stops);
                caption(ui, "From Mandelight");
            }
            cards(ui, library(), stops);
        });
    });
}

/// A card for each gradient; a click copies the stops.
fn cards(ui: &mut Ui, all: impl Iterator<Item = NamedGradient>, stops: &mut Vec<GradientStop>) {
    for NamedGradient { name, stops: own } in all {
        if gradient_card(ui, &name, &own, *stops == own).clicked() {
            *stops = own;
        }
    }
}
