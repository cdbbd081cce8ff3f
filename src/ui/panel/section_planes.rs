//! The planes that cut the set open: direction, position, and the colours of the cuts.

use egui::{Align, Button, Layout, Ui};
use glam::DVec3;

use super::context::{Context, Section};
use crate::{
    formula::{
        param::{Scale, Unit},
        section::{MAX_SECTION_PLANES, SectionPlane},
    },
    scene::{
        Axis, Camera, PrecisePoint, Scene, SectionColors,
        param::{self, Param},
    },
    ui::{
        icon::{Icon, icon_button},
        widgets::{Help as _, caption, choice_button, color, param_slider},
    },
};

/// The section of the panel.
pub(in crate::ui) const SECTION: Section = Section {
    name: "section_planes",
    title: "Section planes",
    hover: "Cuts the fractal open and shows the slice",
    show,
    reset: |cx| reset(cx.scene),
};

/// Removes all planes.
fn reset(scene: &mut Scene) {
    scene.fractal.section_planes.clear();
}

/// Rounding of positions, over the unit in which they are shown.
const GRAIN: f64 = 1e-6;

/// The position of a plane in whole views: its distance from the centre.
const POSITION: Param = Param {
    path: "position",
    label: "Position",
    unit: Unit::SceneUnits,
    min: -1.0,
    max: 1.0,
    default: 0.0,
    scale: Scale::Linear,
    step: 0.01,
    help: "Distance of the plane from the centre. Drag the plane's handle in the view to move it, too.",
};
/// The position of a plane in close views: its distance from the pivot.
const NEAR_POSITION: Param = Param {
    unit: Unit::ViewUnits,
    help: "Distance of the plane from the point that the view turns about. Drag the plane's handle in the view to move it, too.",
    ..POSITION
};

/// The planes, a button for another one, and the colours.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let radius = cx.camera_status.map_or(1.0, |status| status.bounding_radius);
    let camera = &cx.scene.camera;
    let planes = &mut cx.scene.fractal.section_planes;
    let mut removed = None;
    for (index, plane) in planes.iter_mut().enumerate() {
        ui.push_id(index, |ui| {
            ui.horizontal(|ui| {
                caption(ui, &format!("Plane {}", index + 1));
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    let name = format!("Remove plane {}", index + 1);
                    if icon_button(ui, Icon::Cross, &name, "Remove this plane").clicked() {
                        removed = Some(index);
                    }
                });
            });
            directions(ui, plane, camera);
            position(ui, plane, camera, radius);
            param_slider(ui, &param::SECTION_BAND_REACH, &mut plane.band_reach);
        });
        ui.add_space(6.0);
    }
    if let Some(index) = removed {
        planes.remove(index);
    }
    let text = if planes.is_empty() { "Cut open" } else { "Another plane" };
    let hover = "Cuts away the half that faces you. Up to three planes cut together.";
    let add = ui.add_enabled(planes.len() < MAX_SECTION_PLANES, Button::new(text));
    cx.rects.record("add section plane", &add);
    let full = format!("A fractal has at most {MAX_SECTION_PLANES} section planes.");
    if add.help(hover).disabled_help(full).clicked() {
        let new = new_plane(planes, camera);
        planes.push(new);
    }
    if !planes.is_empty() {
        colors(ui, &mut cx.scene.surface.sections);
    }
}

/// Buttons that turn the plane.
fn directions(ui: &mut Ui, plane: &mut SectionPlane, camera: &Camera) {
    ui.horizontal_wrapped(|ui| {
        let normal = plane.normal();
        for (axis, text, hover) in [
            (Axis::X, "X", "Across the x axis: cuts away the side of positive x"),
            (Axis::Y, "Y", "Across the y axis: cuts away the side of positive y"),
            (Axis::Z, "Z", "Across the z axis: cuts away the side of positive z, above"),
        ] {
            let is_chosen = normal.dot(axis.direction()).abs() > 1.0 - 1e-9;
            if choice_button(ui, is_chosen, text).help(hover).clicked() {
                plane.direction = axis.direction().to_array();
            }
        }
        let hover = "Turns the plane toward you: cuts away what is between you and the plane";
        if ui.button("Facing you").help(hover).clicked() {
            plane.direction = (-camera.forward()).normalize().to_array();
        }
        if ui.button("Other half").help("Cuts away the other half instead").clicked() {
            plane.direction = (-normal).to_array();
        }
    });
}

/// Moves the plane along its normal.
fn position(ui: &mut Ui, plane: &mut SectionPlane, camera: &Camera, radius: f64) {
    let (param, length, center) = if camera.is_close() {
        (NEAR_POSITION, camera.view_unit(), camera.pivot.clone())
    } else {
        (Param { min: -radius, max: radius, ..POSITION }, 1.0, PrecisePoint::ORIGIN)
    };
    let normal = plane.normal();
    // Plus zero: a plane through the centre is not at -0.
    let before = (&plane.point - &center).dot(normal) / length + 0.0;
    let mut now = before;
    if param_slider(ui, &param, &mut now).changed() {
        plane.point = plane.point.moved_by(normal * (now - before) * length, GRAIN * length);
    }
}

/// Repeats of the gradient, and the colour of the inside.
fn colors(ui: &mut Ui, colors: &mut SectionColors) {
    ui.add_space(6.0);
    caption(ui, "Colours of the cut");
    param_slider(ui, &param::SECTION_REPEATS, &mut colors.repeats);
    ui.horizontal(|ui| {
        color(ui, "Inside", "Colour of the inside of the set", &mut colors.inside);
        ui.label("Inside");
    });
}

/// A plane across the axis that points toward the eye the most and has none yet.
fn new_plane(planes: &[SectionPlane], camera: &Camera) -> SectionPlane {
    let toward_eye = -camera.forward();
    let used = |axis: DVec3| planes.iter().any(|plane| plane.normal().dot(axis).abs() > 1.0 - 1e-9);
    let axis = [Axis::X, Axis::Y, Axis::Z]
        .map(Axis::direction)
        .into_iter()
        .filter(|axis| !used(*axis))
        .max_by(|a, b| toward_eye.dot(*a).abs().total_cmp(&toward_eye.dot(*b).abs()))
        .unwrap_or(DVec3::Z);
    let direction = axis * if toward_eye.dot(axis) < 0.0 { -1.0 } else { 1.0 };
    let point = if camera.is_close() { camera.pivot.clone() } else { PrecisePoint::ORIGIN };
    let band_reach = param::SECTION_BAND_REACH.default.min(camera.view_unit());
    SectionPlane { point, direction: direction.to_array(), band_reach }
}
