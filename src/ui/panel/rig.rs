//! The rig: many lights made together, from a sky or from an environment map.

use egui::{Button, Response, RichText, Ui, vec2};
use glam::DVec3;

use super::{Context, light};
use crate::{
    scene::{
        Background, BackgroundKind, Camera, EnvironmentMap, LightFrame, Lights, Rig, RigKind, param,
    },
    ui::{
        Action, theme,
        widgets::{ball, choice, color, param_slider, param_slider_count},
    },
};

/// What the rig is made from, and what belongs to that.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let before = cx.scene.lights.rig.kind;
    let chosen = choice(
        ui,
        "Rig",
        &mut cx.scene.lights.rig.kind,
        &[
            (RigKind::None, "None", "No lights beside those of the list"),
            (RigKind::Sky, "Sky", "Lights that stand for a sky with a sun"),
            (RigKind::Picture, "Picture", "Lights taken from a 360° picture (an environment map)"),
        ],
    );
    cx.rects.record("rig", &chosen);
    let come_along = light_here(ui, &cx.scene.lights);
    if come_along.clicked() {
        tie_to_view(&mut cx.scene.lights);
    }
    cx.rects.record("light here", &come_along);
    let turned_on = cx.scene.lights.rig.kind != before;
    match cx.scene.lights.rig.kind {
        RigKind::None => {}
        RigKind::Sky => sky(ui, cx),
        RigKind::Picture => picture(ui, cx),
    }
    // A scene can show its picture and be lit by something else.
    if !cx.scene.lights.rig.picture.name.is_empty() {
        behind(ui, &mut cx.scene.background);
    }
    if cx.scene.lights.rig.kind != RigKind::None && !cx.scene.lights.rig.is_empty() {
        common(ui, &mut cx.scene.lights.rig, &cx.scene.camera);
    }
    keep_within_room(&mut cx.scene.lights, cx.environment_map, turned_on.then_some(before));
}

/// Asks for light that comes along.
fn light_here(ui: &mut Ui, lights: &Lights) -> Response {
    let (room, least) = (lights.room_for_rig(), param::RIG_COUNT.min as usize);
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = Button::new("Light what is in view").truncate();
    ui.add_enabled_ui(room >= least && !is_tied_to_view(&lights.rig), |ui| ui.add_sized(size, button))
        .inner
        .on_hover_text("A sky that comes along with you, and in which only what is near casts shadows: it lights any place, however deep")
        .on_disabled_hover_text(if room < least {
            "The scene has no room for further lights"
        } else {
            "The rig comes along with you already, with near shadows"
        })
}

fn is_tied_to_view(rig: &Rig) -> bool {
    let near_shadows = !rig.casts_shadows || rig.shadow_reach.is_some();
    !rig.is_empty() && rig.frame == LightFrame::View && near_shadows && !rig.muted
}

/// Makes the rig one that comes along with the camera and is shaded by what is near. A sky keeps
/// its colours; its sun moves behind the viewer's left shoulder.
fn tie_to_view(lights: &mut Lights) {
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

/// Sees to it that the scene has no more lights than it can hold; where there is no room for a
/// rig at all, it stays what it was `before`.
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
        RigKind::Picture => {
            match environment_map.filter(|at_hand| is_named(&lights.rig, at_hand)) {
                Some(environment_map) => lights.rig.light_by(environment_map, room),
                None => lights.rig.kind = before.unwrap_or_default(),
            }
        }
        _ => lights.rig.kind = before.unwrap_or_default(),
    }
}

fn is_named(rig: &Rig, environment_map: &EnvironmentMap) -> bool {
    rig.picture.name == environment_map.name()
}

fn sky(ui: &mut Ui, cx: &mut Context<'_>) {
    let camera = &cx.scene.camera;
    let rig = &mut cx.scene.lights.rig;
    ui.horizontal(|ui| {
        let sky = &mut rig.sky;
        let mut toward = light::in_view(sky.sun_direction, rig.frame, camera);
        let response = ball(ui, "Sun direction", 112.0, sky.sun_color, &mut toward);
        if response.changed() {
            sky.sun_direction = light::from_view(toward, rig.frame, camera);
        }
        cx.rects.record("sun ball", &response);
        ui.vertical(|ui| {
            let mut row = |name: &str, hover: &str, value: &mut [f32; 3]| {
                ui.horizontal(|ui| {
                    color(ui, &format!("{name} colour"), hover, value);
                    ui.label(RichText::new(name).color(theme::TEXT_DIM));
                });
            };
            row("Sun", "The sun's colour", &mut sky.sun_color);
            row("Zenith", "The sky's colour straight up", &mut sky.zenith);
            row("Horizon", "The sky's colour at the horizon", &mut sky.horizon);
            row("Ground", "The colour of the light from below", &mut sky.ground);
        });
    });
    param_slider(ui, &param::SUN_STRENGTH, &mut rig.sky.sun_strength);
    param_slider(ui, &param::SUN_SIZE, &mut rig.sky.sun_size_deg);
    param_slider_count(ui, &param::SUN_LIGHTS, &mut rig.sky.sun_lights);
    param_slider_count(ui, &param::RIG_COUNT, &mut rig.count);
}

fn picture(ui: &mut Ui, cx: &mut Context<'_>) {
    let response = choose(ui);
    cx.rects.record("choose picture", &response);
    if response.clicked() {
        cx.actions.push(Action::ChoosePicture);
    }
    let room = cx.scene.lights.room_for_rig();
    let rig = &mut cx.scene.lights.rig;
    let at_hand = cx.environment_map.filter(|environment_map| is_named(rig, environment_map));
    let text = match (rig.picture.name.as_str(), at_hand) {
        ("", _) => "A Radiance (.hdr) or OpenEXR (.exr) picture of all directions. It can be dropped on the page, too.".to_owned(),
        (name, Some(environment_map)) => {
            let [width, height] = environment_map.size_px();
            format!("{name}, {width} × {height}, as {} lights", rig.picture.lights.len())
        }
        (name, None) => format!(
            "{name} is not at hand: its {} lights are kept. Choose it again to divide it anew or to see it.",
            rig.picture.lights.len()
        ),
    };
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
    let before = rig.count;
    ui.add_enabled_ui(at_hand.is_some(), |ui| {
        param_slider_count(ui, &param::RIG_COUNT, &mut rig.count)
    });
    if let Some(environment_map) = at_hand
        && rig.count != before
    {
        rig.light_by(environment_map, room);
    }
    param_slider(ui, &param::RIG_ROTATION, &mut rig.picture.rotation_deg);
}

fn choose(ui: &mut Ui) -> Response {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.add_sized(size, Button::new("Choose picture…").truncate())
        .on_hover_text("Choose a Radiance (.hdr) or OpenEXR (.exr) environment map")
}

/// Whether the picture is seen behind the fractal.
fn behind(ui: &mut Ui, background: &mut Background) {
    let mut shown = background.kind == BackgroundKind::Picture;
    let response = ui
        .checkbox(&mut shown, "Show it behind the fractal")
        .on_hover_text("Shows the environment map as the background");
    if response.changed() {
        background.kind = if shown { BackgroundKind::Picture } else { BackgroundKind::Gradient };
    }
}

/// What all rigs have.
fn common(ui: &mut Ui, rig: &mut Rig, camera: &Camera) {
    param_slider(ui, &param::RIG_INTENSITY, &mut rig.intensity);
    ui.horizontal_wrapped(|ui| {
        ui.checkbox(&mut rig.casts_shadows, "Rig shadows")
            .on_hover_text("Whether surfaces block the rig's lights");
        let mut limited = rig.shadow_reach.is_some();
        let reach = egui::Checkbox::new(&mut limited, "Limit rig reach");
        let reach = ui.add_enabled(rig.casts_shadows, reach).on_hover_text(
            "Let only near surfaces cast shadows from the rig; otherwise the whole scene does",
        );
        if reach.changed() {
            rig.shadow_reach = limited.then_some(param::RIG_SHADOW_REACH.default);
        }
        ui.checkbox(&mut rig.muted, "Mute rig").on_hover_text("Switch the rig off for now");
        ui.checkbox(&mut rig.solo, "Solo rig")
            .on_hover_text("While anything is solo, only solo lights shine");
    });
    if let Some(reach) = &mut rig.shadow_reach {
        ui.add_enabled_ui(rig.casts_shadows, |ui| {
            param_slider(ui, &param::RIG_SHADOW_REACH, reach)
        });
    }
    let before = rig.frame;
    choice(
        ui,
        "Rig fixed to",
        &mut rig.frame,
        &[
            (LightFrame::Scene, "Scene", "The rig stays where it is as the camera moves"),
            (LightFrame::View, "View", "The rig moves with the camera"),
        ],
    );
    if rig.frame != before {
        // Fixed to something else, the sun still shines from where it shone.
        let sun = light::in_view(rig.sky.sun_direction, before, camera);
        rig.sky.sun_direction = light::from_view(sun, rig.frame, camera);
    }
}
