//! The rig panel: many lights, generated from a sky or from an environment map.

use egui::{Button, Response, RichText, Ui, vec2};
use glam::DVec3;

use super::context::Context;
use crate::{
    scene::{
        Background, BackgroundKind, Camera, EnvironmentMap, LightFrame, Lights, Rig, RigKind, param,
    },
    ui::{
        action::Action,
        theme,
        widgets::{Help as _, ball, choice, color, param_slider, param_slider_count},
    },
};

/// The rig's source and its settings.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let before = cx.scene.lights.rig.kind;
    let chosen = choice(
        ui,
        "Sky light",
        &mut cx.scene.lights.rig.kind,
        &[
            (RigKind::None, "None", "Only the lights of the list above"),
            (RigKind::Sky, "Sky", "Adds the light of a sky with a sun"),
            (
                RigKind::EnvironmentMap,
                "Environment map",
                "Adds the light of an environment map: a picture of everything around, in all directions",
            ),
        ],
    );
    cx.rects.record("rig", &chosen);
    let light_here = light_view_button(ui, &cx.scene.lights);
    if light_here.clicked() {
        attach_to_view(&mut cx.scene.lights);
    }
    cx.rects.record("light here", &light_here);
    let turned_on = cx.scene.lights.rig.kind != before;
    match cx.scene.lights.rig.kind {
        RigKind::None => {}
        RigKind::Sky => sky(ui, cx),
        RigKind::EnvironmentMap => map_settings(ui, cx),
    }
    // A scene can show an environment map and be lit by another source.
    if !cx.scene.lights.rig.environment_map.name.is_empty() {
        background(ui, &mut cx.scene.background);
    }
    if cx.scene.lights.rig.kind != RigKind::None && !cx.scene.lights.rig.is_empty() {
        common(ui, &mut cx.scene.lights.rig, &cx.scene.camera);
    }
    keep_within_room(&mut cx.scene.lights, cx.environment_map, turned_on.then_some(before));
}

/// The button that attaches the rig to the view.
fn light_view_button(ui: &mut Ui, lights: &Lights) -> Response {
    let (room, min) = (lights.room_for_rig(), param::RIG_COUNT.min as usize);
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = Button::new("Light what is in view").truncate();
    ui.add_enabled_ui(room >= min && !is_attached_to_view(&lights.rig), |ui| ui.add_sized(size, button))
        .inner
        .help("Lights what you see, at any zoom: a sky that moves with the camera, with shadows of near surfaces only")
        .disabled_help(if room < min {
            "The scene has no room for more lights"
        } else {
            "The light already moves with the camera, with shadows of near surfaces only"
        })
}

fn is_attached_to_view(rig: &Rig) -> bool {
    let near_shadows = !rig.casts_shadows || rig.shadow_reach.is_some();
    !rig.is_empty() && rig.frame == LightFrame::View && near_shadows && !rig.muted
}

/// Fixes the rig to the camera's frame and limits its shadows to near surfaces.
///
/// A sky keeps its colours; its sun moves behind the viewer's left shoulder.
fn attach_to_view(lights: &mut Lights) {
    let room = lights.room_for_rig();
    let rig = &mut lights.rig;
    if rig.is_empty() {
        rig.kind = RigKind::Sky;
        rig.count = rig.count.min(room as u32);
    }
    if rig.kind == RigKind::Sky {
        rig.sky.sun_direction = DVec3::new(-0.5, 0.6, 0.65).normalize().to_array();
    }
    rig.frame = LightFrame::View;
    rig.shadow_reach = Some(rig.shadow_reach.unwrap_or(param::RIG_SHADOW_REACH.default));
    rig.muted = false;
}

/// Reduces the rig to the number of lights that the scene has room for.
///
/// Without room for a rig, its kind is reset to `before`.
fn keep_within_room(
    lights: &mut Lights,
    environment_map: Option<&EnvironmentMap>,
    before: Option<RigKind>,
) {
    let room = lights.room_for_rig();
    if lights.rig.len() <= room {
        return;
    }
    match lights.rig.kind {
        RigKind::Sky if room >= param::RIG_COUNT.min as usize => lights.rig.count = room as u32,
        RigKind::EnvironmentMap => {
            match environment_map.filter(|loaded| is_named(&lights.rig, loaded)) {
                Some(environment_map) => lights.rig.light_by(environment_map, room),
                None => lights.rig.kind = before.unwrap_or_default(),
            }
        }
        _ => lights.rig.kind = before.unwrap_or_default(),
    }
}

fn is_named(rig: &Rig, environment_map: &EnvironmentMap) -> bool {
    rig.environment_map.name == environment_map.name()
}

/// The ball that edits the direction of the sky's sun; `name` is for screen readers.
pub(super) fn sun_ball(
    ui: &mut Ui,
    name: &str,
    diameter: f32,
    rig: &mut Rig,
    camera: &Camera,
) -> Response {
    let mut toward = rig.toward_sun_in_view(camera);
    let response = ball(ui, name, diameter, rig.sky.sun_color, &mut toward);
    if response.changed() {
        rig.set_toward_sun_in_view(toward, camera);
    }
    response
}

fn sky(ui: &mut Ui, cx: &mut Context<'_>) {
    let camera = &cx.scene.camera;
    let rig = &mut cx.scene.lights.rig;
    ui.horizontal(|ui| {
        let response = sun_ball(ui, "Sun direction", 112.0, rig, camera);
        cx.rects.record("sun ball", &response);
        let sky = &mut rig.sky;
        ui.vertical(|ui| {
            let mut row = |name: &str, hover: &str, value: &mut [f32; 3]| {
                ui.horizontal(|ui| {
                    color(ui, &format!("{name} colour"), hover, value);
                    ui.label(RichText::new(name).color(theme::TEXT_DIM));
                });
            };
            row("Sun", "The colour of the sun's light", &mut sky.sun_color);
            row("Zenith", "The sky's colour overhead", &mut sky.zenith);
            row("Horizon", "The sky's colour at the horizon", &mut sky.horizon);
            row("Ground", "The colour of the light from below", &mut sky.ground);
        });
    });
    param_slider(ui, &param::SUN_STRENGTH, &mut rig.sky.sun_strength);
    param_slider(ui, &param::SUN_SIZE, &mut rig.sky.sun_size_deg);
    param_slider_count(ui, &param::SUN_LIGHTS, &mut rig.sky.sun_lights);
    param_slider_count(ui, &param::RIG_COUNT, &mut rig.count);
}

fn map_settings(ui: &mut Ui, cx: &mut Context<'_>) {
    let response = choose(ui);
    cx.rects.record("choose picture", &response);
    if response.clicked() {
        cx.actions.push(Action::ChooseEnvironmentMap);
    }
    let room = cx.scene.lights.room_for_rig();
    let rig = &mut cx.scene.lights.rig;
    let loaded = cx.environment_map.filter(|environment_map| is_named(rig, environment_map));
    let text = match (rig.environment_map.name.as_str(), loaded) {
        ("", _) => {
            "An environment map is a picture of everything around, Radiance (.hdr) or OpenEXR (.exr). You can also drop it on the page."
                .to_owned()
        }
        (name, Some(environment_map)) => {
            let [width, height] = environment_map.size_px();
            format!("{name}, {width} × {height}, as {} lights", rig.environment_map.lights.len())
        }
        (name, None) => format!(
            "{name} is not loaded; its {} lights still shine. Choose the file again to show it or to change the number of lights.",
            rig.environment_map.lights.len()
        ),
    };
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
    let before = rig.count;
    ui.add_enabled_ui(loaded.is_some(), |ui| {
        param_slider_count(ui, &param::RIG_COUNT, &mut rig.count)
    });
    if let Some(environment_map) = loaded
        && rig.count != before
    {
        rig.light_by(environment_map, room);
    }
    param_slider(ui, &param::RIG_ROTATION, &mut rig.environment_map.rotation_deg);
}

fn choose(ui: &mut Ui) -> Response {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.add_sized(size, Button::new("Choose environment map…").truncate())
        .help("Choose an environment map, Radiance (.hdr) or OpenEXR (.exr)")
}

/// The switch that shows the environment map behind the fractal.
fn background(ui: &mut Ui, background: &mut Background) {
    let mut shown = background.kind == BackgroundKind::EnvironmentMap;
    let response = ui
        .checkbox(&mut shown, "Show the map behind the fractal")
        .help("Shows the environment map instead of the background colours");
    if response.changed() {
        background.kind =
            if shown { BackgroundKind::EnvironmentMap } else { BackgroundKind::Gradient };
    }
}

/// The settings of every kind of rig.
fn common(ui: &mut Ui, rig: &mut Rig, camera: &Camera) {
    param_slider(ui, &param::RIG_INTENSITY, &mut rig.intensity);
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut rig.casts_shadows, "Sky shadows")
            .help("The light of the sky casts shadows");
        let mut limited = rig.shadow_reach.is_some();
        let reach = egui::Checkbox::new(&mut limited, "Near sky shadows only");
        let reach = ui
            .add_enabled(rig.casts_shadows, reach)
            .help("Only near surfaces cast shadows from the sky. Brightens the picture.");
        if reach.changed() {
            rig.shadow_reach = limited.then_some(param::RIG_SHADOW_REACH.default);
        }
        ui.checkbox(&mut rig.muted, "Sky off").help("Switch the light of the sky off");
        ui.checkbox(&mut rig.solo, "Only the sky").help("Only the lights marked so shine");
    });
    if let Some(reach) = &mut rig.shadow_reach {
        ui.add_enabled_ui(rig.casts_shadows, |ui| {
            param_slider(ui, &param::RIG_SHADOW_REACH, reach)
        });
    }
    let before = rig.frame;
    choice(
        ui,
        "Sky stays with",
        &mut rig.frame,
        &[
            (LightFrame::Scene, "Scene", "The sky stays in place while the camera moves"),
            (LightFrame::View, "Camera", "The sky moves with the camera"),
        ],
    );
    if rig.frame != before {
        // The sun keeps its current direction in the new frame.
        let sun = before.to_view(rig.sky.sun_direction, camera);
        rig.set_toward_sun_in_view(sun, camera);
    }
}
