//! The lights panel: a list of lights, and the selected light's properties.

use egui::{Button, Id, Response, RichText, ScrollArea, Ui, vec2};
use glam::DVec3;

use super::{
    context::{Context, Section},
    light, rig,
};
use crate::{
    scene::{
        Camera, EnvironmentLight, Lights, MAX_LIGHTS, PointLight, RigKind, Scene, follow, param,
    },
    ui::{
        light_handles::is_used_by_keyboard,
        selection::{LightRef, Selection},
        shortcuts::Command,
        theme,
        widgets::{Help as _, arrow_steps, button_row, caption, color, param_slider},
    },
};

/// Diameter of the key light's ball, in points.
const KEY_BALL: f32 = 84.0;
/// Number of lights that the list shows without scrolling.
const MAX_SHOWN_ROWS: f32 = 6.0;
/// Gap between the list's rows, in points.
const ROW_GAP: f32 = 2.0;

/// The essential controls of light: the key light's direction and colour, and the exposure.
pub(super) fn key_light(ui: &mut Ui, cx: &mut Context<'_>) {
    // The ball stays while the section of all lights shows its own: nothing moves under the pointer.
    let shown = ui.scope(|ui| {
        caption(ui, "Key light");
        edit_as_seen(ui, cx, key_ball);
    });
    let is_at_keyboard = |focused| {
        let control = ui.ctx().read_response(focused);
        control.is_some_and(|control| {
            shown.response.rect.contains(control.rect.center()) && is_used_by_keyboard(&control)
        })
    };
    let is_at_keyboard = ui.memory(|memory| memory.focused()).is_some_and(is_at_keyboard);
    cx.selection.uses_lights |= ui.rect_contains_pointer(shown.response.rect) || is_at_keyboard;
    let response = param_slider(ui, &param::EXPOSURE, &mut cx.scene.tone.exposure);
    cx.rects.record("exposure", &response);
}

/// What the key light's ball moves.
#[derive(Clone, Copy, PartialEq)]
enum KeyLight {
    /// The selected directional light, or the first, by its index.
    Light(usize),
    /// The sky's sun, where there is no directional light.
    Sun,
    /// Nothing.
    None,
}

impl KeyLight {
    fn of(lights: &Lights, selected: Option<LightRef>) -> Self {
        let count = lights.environment.len();
        match selected {
            Some(LightRef::Environment(index)) if index < count => Self::Light(index),
            _ if count > 0 => Self::Light(0),
            _ if lights.rig.kind == RigKind::Sky => Self::Sun,
            _ => Self::None,
        }
    }
}

/// The direction and colour of the key light.
fn key_ball(ui: &mut Ui, cx: &mut Context<'_>) {
    let Scene { camera, lights, .. } = &mut *cx.scene;
    let key = KeyLight::of(lights, cx.selection.light);
    ui.horizontal(|ui| {
        let name = "Key light direction";
        let ball = match key {
            KeyLight::Light(index) => {
                let light = &mut lights.environment[index];
                Some(light::direction_ball(ui, name, KEY_BALL, light, camera))
            }
            KeyLight::Sun => Some(rig::sun_ball(ui, name, KEY_BALL, &mut lights.rig, camera)),
            KeyLight::None => None,
        };
        if let Some(response) = &ball {
            cx.rects.record("key light ball", response);
        }
        ui.vertical(|ui| {
            // egui lets a text be half a point wider than its column.
            ui.set_max_width((ui.available_width() - 0.5).max(0.0));
            ui.add_space(4.0);
            let (what, value) = match key {
                KeyLight::Light(index) => {
                    let name = LightRef::Environment(index).name().to_lowercase();
                    let what = format!("Drag the dot to move {name}.");
                    (what, Some(&mut lights.environment[index].color))
                }
                KeyLight::Sun => {
                    let what = "Drag the dot to move the sun.".to_owned();
                    (what, Some(&mut lights.rig.sky.sun_color))
                }
                KeyLight::None => ("This scene has no key light.".to_owned(), None),
            };
            ui.label(RichText::new(what).color(theme::TEXT_DIM));
            ui.add_space(4.0);
            if let Some(value) = value {
                color(ui, "Key light colour", "The colour of this light", value);
                ui.add_space(4.0);
            }
            let which = match key {
                KeyLight::Light(_) => "this light moves to where it reaches",
                KeyLight::Sun | KeyLight::None if lights.point.is_empty() => "a new light shines on",
                KeyLight::Sun | KeyLight::None => "a point light moves to where it reaches",
            };
            let response = ui.button("Light a place").help(format!("Then click the surface: {which} that place (Alt + Shift + click). By keyboard: Tab to the view, then Enter for its middle"));
            cx.rects.record("light a place", &response);
            if response.clicked() {
                if let KeyLight::Light(index) = key {
                    cx.selection.light = Some(LightRef::Environment(index));
                }
                cx.commands.push(Command::LightPlace);
            }
        });
    });
}

/// Shows and edits the lights as they shine in this view, which may have turned toward it.
fn edit_as_seen(ui: &mut Ui, cx: &mut Context<'_>, show: fn(&mut Ui, &mut Context<'_>)) {
    let Some(seen) = follow::shown(&cx.scene.lights, &cx.scene.camera) else {
        return show(ui, cx);
    };
    let document = std::mem::replace(&mut cx.scene.lights, seen.clone());
    show(ui, cx);
    let edited = std::mem::take(&mut cx.scene.lights);
    cx.scene.lights = follow::with_edit(document, &seen, edited, &cx.scene.camera);
}

/// The section of the panel.
pub(super) const SECTION: Section = Section {
    name: "lights",
    title: "All lights",
    hover: "The list of lights, their colours and shadows, and the light of a sky or an environment map",
    show,
    reset: |cx| reset(cx.scene),
};

/// Restores the lights of a new scene.
fn reset(scene: &mut Scene) {
    scene.lights = Lights::default();
}

/// The switch of lights that follow, and all lights.
fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let follows = ui
        .checkbox(&mut cx.scene.lights.follow_view, "Follow close views")
        .help(
            "Very close to the surface, the lights turn with you and shadows of far surfaces fade, so that what you see stays lit. The whole fractal keeps its lights in place. Turning a light there ends this.",
        );
    cx.rects.record("follow view", &follows);
    edit_as_seen(ui, cx, list_and_selected);
}

/// The list of all lights, the selected one's properties, and the rig.
fn list_and_selected(ui: &mut Ui, cx: &mut Context<'_>) {
    if cx.selection.light.is_none_or(|light| !light.exists(&cx.scene.lights)) {
        cx.selection.light = first(&cx.scene.lights);
    }
    list(ui, cx);
    buttons(ui, cx);
    match cx.selection.light {
        Some(LightRef::Environment(index)) => {
            let camera = &cx.scene.camera;
            if let Some(light) = cx.scene.lights.environment.get_mut(index) {
                let ball = light::environment(ui, light, camera);
                cx.rects.record("light ball", &ball);
            }
        }
        Some(LightRef::Point(index)) => {
            let camera = &cx.scene.camera;
            if let Some(light) = cx.scene.lights.point.get_mut(index) {
                light::point(ui, light, camera);
            }
        }
        None if cx.scene.lights.is_empty() => {
            ui.label(
                RichText::new(
                    "There is no light: only ambient light and glowing surfaces are visible.",
                )
                .color(theme::TEXT_DIM),
            );
        }
        None => {}
    }
    rig::show(ui, cx);
}

fn first(lights: &Lights) -> Option<LightRef> {
    [LightRef::Environment(0), LightRef::Point(0)].into_iter().find(|light| light.exists(lights))
}

fn list(ui: &mut Ui, cx: &mut Context<'_>) {
    let Selection { light: selected, moved_light, .. } = cx.selection;
    let lights = &mut cx.scene.lights;
    let row_height = ui.spacing().interact_size.y + ROW_GAP;
    let height = row_height * MAX_SHOWN_ROWS;
    // A light that was selected elsewhere, or is new, scrolls into sight.
    let last_shown = Id::unique("light scrolled to");
    let is_new = ui.data(|data| data.get_temp(last_shown)) != Some(*selected);
    ui.data_mut(|data| data.insert_temp(last_shown, *selected));
    let shown = ScrollArea::vertical()
        .id_salt("light list")
        .min_scrolled_height(height)
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = ROW_GAP;
            let environment = lights.environment.iter_mut().enumerate().map(|(index, light)| {
                let this = LightRef::Environment(index);
                (this, &mut light.color, &mut light.muted, &mut light.solo)
            });
            let point = lights.point.iter_mut().enumerate().map(|(index, light)| {
                let this = LightRef::Point(index);
                (this, &mut light.color, &mut light.muted, &mut light.solo)
            });
            for (this, color, muted, solo) in environment.chain(point) {
                let row = row(ui, this, selected, color, muted, solo);
                if let Some(steps) = arrow_steps(ui, &row) {
                    (*selected, *moved_light) = (Some(this), Some((this, steps)));
                }
                if is_new && *selected == Some(this) {
                    row.scroll_to_me(None);
                }
            }
        });
    cx.rects.record_rect("light list", shown.inner_rect);
}

/// A light's row: colour, name, and whether it is off or shines alone. Returns the name's response.
fn row(
    ui: &mut Ui,
    this: LightRef,
    selected: &mut Option<LightRef>,
    linear: &mut [f32; 3],
    muted: &mut bool,
    solo: &mut bool,
) -> Response {
    let name = this.name();
    ui.push_id((this.name(), "row"), |ui| {
        ui.horizontal(|ui| {
            let height = ui.spacing().interact_size.y;
            color(ui, &format!("{name} colour"), "The colour of this light", linear);
            let width = (ui.available_width()
                - 2.0 * (height.max(TOGGLE_WIDTH) + ui.spacing().item_spacing.x))
                .max(40.0);
            let chosen = *selected == Some(this);
            let text =
                RichText::new(&name).color(if *muted { theme::TEXT_DIM } else { theme::TEXT });
            let button = Button::selectable(chosen, text).min_size(vec2(width, height)).truncate();
            let response = ui
                .add_sized(vec2(width, height), button)
                .help("Select this light to edit it below. The arrow keys move it in the view.");
            if response.clicked() {
                *selected = Some(this);
            }
            toggle(ui, "Off", &format!("{name} off"), "Switch this light off", muted);
            toggle(ui, "Only", &format!("Only {name}"), "Only the lights marked so shine", solo);
            response
        })
        .inner
    })
    .inner
}

/// Width of a row's switches, in points.
const TOGGLE_WIDTH: f32 = 46.0;
/// Space beside a switch's word, in points.
const TOGGLE_PADDING: f32 = 2.0;

fn toggle(ui: &mut Ui, word: &str, name: &str, hover: &str, on: &mut bool) {
    let side = ui.spacing().interact_size.y;
    let fill = if *on { theme::ACCENT } else { theme::RAISED };
    let text =
        RichText::new(word).small().color(if *on { theme::ON_ACCENT } else { theme::TEXT_DIM });
    // A wider button would widen the panel.
    ui.spacing_mut().button_padding.x = TOGGLE_PADDING;
    let response =
        ui.add_sized(vec2(side.max(TOGGLE_WIDTH), side), Button::new(text).fill(fill)).help(hover);
    if response.clicked() {
        *on = !*on;
    }
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_toggled((*on).into()));
    response.accessible_name(name);
}

/// What a button below the list does.
#[derive(Clone, Copy)]
enum ListEdit {
    Add,
    AddPoint,
    Duplicate,
    Remove,
}

/// The buttons below the list.
fn buttons(ui: &mut Ui, cx: &mut Context<'_>) {
    let has_room = cx.scene.lights.len() < MAX_LIGHTS;
    let is_selected = cx.selection.light.is_some();
    let hover = "Add parallel light, like the sun's, from your upper left";
    let add = ("Add light", hover, has_room, ListEdit::Add);
    let hover = "Add a lamp between you and the fractal";
    let add_point = ("Add point light", hover, has_room, ListEdit::AddPoint);
    let hover = "Add a copy of the selected light";
    let duplicate = ("Duplicate", hover, has_room && is_selected, ListEdit::Duplicate);
    let remove = ("Remove", "Remove the selected light", is_selected, ListEdit::Remove);
    let mut clicked = None;
    ui.add_space(4.0);
    for row in [[add, add_point], [duplicate, remove]] {
        button_row(ui, row.len(), |ui, index, size| {
            let (name, hover, is_enabled, edit) = row[index];
            let button = Button::new(name).truncate();
            let mut response =
                ui.add_enabled_ui(is_enabled, |ui| ui.add_sized(size, button)).inner.help(hover);
            if !has_room {
                response =
                    response.disabled_help(format!("A scene has at most {MAX_LIGHTS} lights."));
            }
            cx.rects.record(name, &response);
            if response.clicked() {
                clicked = Some(edit);
            }
        });
    }
    ui.add_space(4.0);
    if let Some(edit) = clicked {
        cx.selection.light = edited(cx.scene, cx.selection.light, edit);
    }
}

/// Edits the lists of lights, and returns the light to select.
fn edited(scene: &mut Scene, selected: Option<LightRef>, edit: ListEdit) -> Option<LightRef> {
    let Scene { lights, camera, .. } = scene;
    match edit {
        ListEdit::Add => {
            lights.environment.push(new_environment(camera));
            Some(LightRef::Environment(lights.environment.len() - 1))
        }
        ListEdit::AddPoint => {
            lights.point.push(new_point(camera));
            Some(LightRef::Point(lights.point.len() - 1))
        }
        ListEdit::Duplicate => selected.map(|light| duplicated(lights, light)),
        ListEdit::Remove => selected.and_then(|light| removed(lights, light)),
    }
}

/// Adds a copy of `light` at the end of its list.
fn duplicated(lights: &mut Lights, light: LightRef) -> LightRef {
    match light {
        LightRef::Environment(index) => {
            if let Some(copy) = lights.environment.get(index).cloned() {
                lights.environment.push(copy);
            }
            LightRef::Environment(lights.environment.len().saturating_sub(1))
        }
        LightRef::Point(index) => {
            if let Some(copy) = lights.point.get(index).cloned() {
                lights.point.push(copy);
            }
            LightRef::Point(lights.point.len().saturating_sub(1))
        }
    }
}

/// Removes `light` and returns a neighbour to select.
fn removed(lights: &mut Lights, light: LightRef) -> Option<LightRef> {
    let neighbour = match light {
        LightRef::Environment(index) if index < lights.environment.len() => {
            lights.environment.remove(index);
            LightRef::Environment(index.min(lights.environment.len().saturating_sub(1)))
        }
        LightRef::Point(index) if index < lights.point.len() => {
            lights.point.remove(index);
            LightRef::Point(index.min(lights.point.len().saturating_sub(1)))
        }
        missing => missing,
    };
    if neighbour.exists(lights) { Some(neighbour) } else { first(lights) }
}

fn new_environment(camera: &Camera) -> EnvironmentLight {
    let mut light = EnvironmentLight::default();
    light.set_toward_light_in_view(DVec3::new(-0.55, 0.5, 0.67), camera);
    light
}

/// A new point light, at the upper left of the view, halfway to the edge.
///
/// Its strength at the pivot is about that of an environment light.
fn new_point(camera: &Camera) -> PointLight {
    let unit = camera.view_unit();
    let depth = 0.6;
    let shift = 0.5 * depth * camera.half_height(1.0);
    let offset = camera.rotation() * (DVec3::new(-shift, shift, -depth) * unit);
    let distance = 0.5 * unit;
    PointLight {
        position: camera.position.moved_by(offset, unit * 1e-4),
        intensity: param::POINT_INTENSITY.clamp(distance * distance),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_new_point_light_is_in_the_view() {
        for fov in [param::VERTICAL_FOV.min, param::VERTICAL_FOV.default, param::VERTICAL_FOV.max] {
            let camera = Camera { vertical_fov_deg: fov, ..Camera::default() };
            let offset = &new_point(&camera).position - &camera.position;
            let seen = camera.rotation().inverse() * offset;
            let edge = camera.half_height(1.0) * -seen.z;
            assert!(
                seen.z < 0.0 && seen.x.abs() < 0.6 * edge && seen.y.abs() < 0.6 * edge,
                "{fov}"
            );
        }
    }

    #[test]
    fn a_new_point_light_lights_the_view_at_every_scale() {
        for unit in [1.0, 1e-5, 1e-13, 1e-20, 1e-27] {
            let mut camera = Camera::default();
            camera.position = camera.position.moved_by(DVec3::X / 3.0, 0.0);
            camera.pivot = camera.position.moved_by(camera.forward() * unit, 0.0);
            let light = new_point(&camera);
            let at_pivot = (&light.position - &camera.pivot).length();
            let strength = light.intensity / (at_pivot * at_pivot);
            assert!((0.5..2.0).contains(&strength), "{unit:e}: {strength}");
            let scene = Scene {
                camera,
                lights: Lights { point: vec![light], ..Default::default() },
                ..Default::default()
            };
            assert_eq!(scene.validate(), Ok(()), "{unit:e}");
            let saved = serde_json::to_string(&scene).expect("a document");
            assert_eq!(serde_json::from_str::<Scene>(&saved).ok(), Some(scene), "{unit:e}");
        }
    }

    #[test]
    fn removing_a_light_selects_a_remaining_light() {
        let mut lights = Lights {
            environment: vec![EnvironmentLight::default()],
            point: vec![PointLight::default(); 2],
            ..Default::default()
        };
        assert_eq!(removed(&mut lights, LightRef::Point(1)), Some(LightRef::Point(0)));
        assert_eq!(removed(&mut lights, LightRef::Point(0)), Some(LightRef::Environment(0)));
        assert_eq!(removed(&mut lights, LightRef::Environment(0)), None);
        assert_eq!(removed(&mut lights, LightRef::Environment(7)), None);
    }
}
