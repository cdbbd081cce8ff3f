//! The camera path as a strip: a ruler to scrub, keys to drag, and what is done with them.

use egui::{Button, Response, RichText, Ui, vec2};

use super::{Context, export};
use crate::{
    scene::{
        Path,
        param::{Param, Scale, Unit},
        path::{Easing, FRAME_RATE, KEY_TIME, MAX_KEYS},
    },
    ui::{
        Action,
        icon::{Icon, icon_button},
        shortcuts::Command,
        theme,
        timeline::Timeline,
        widgets::number,
    },
};

mod track;

/// Strips at least this wide, in points, have all buttons above the track.
const ONE_ROW_FROM: f32 = 740.0;

/// A frame's number; the most are an hour at the highest rate.
const FRAME: Param = Param {
    path: "export.frame",
    label: "Frame",
    unit: Unit::Count,
    min: 0.0,
    max: KEY_TIME.max * FRAME_RATE.max,
    default: 0.0,
    scale: Scale::Integer,
    step: 1.0,
    help: "A frame of the sequence.",
};

/// Draws the strip over the width of `ui`.
pub(in crate::ui) fn strip(
    ui: &mut Ui,
    cx: &mut Context<'_>,
    path: &mut Path,
    timeline: &mut Timeline,
) {
    let on_path = timeline.was_on_path();
    let wide = ui.available_width() >= ONE_ROW_FROM;
    let mut strip = Strip { cx, path, timeline, on_path };
    ui.spacing_mut().item_spacing.y = 4.0;
    ui.horizontal(|ui| {
        strip.transport(ui);
        if wide {
            strip.keys(ui);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let close = icon_button(ui, Icon::Cross, "Hide timeline", "Hide the timeline (T)");
            if close.clicked() {
                strip.cx.commands.push(Command::ToggleTimeline);
            }
        });
    });
    let response = track::show(ui, strip.path, strip.timeline, on_path);
    strip.cx.rects.record("timeline track", &response);
    if wide {
        ui.horizontal(|ui| {
            strip.key_under_edit(ui);
            strip.rate(ui);
            strip.frames(ui);
            strip.save(ui);
        });
    } else {
        ui.horizontal_wrapped(|ui| strip.keys(ui));
        if strip.timeline.selected(strip.path).is_some() {
            ui.horizontal(|ui| strip.key_under_edit(ui));
        }
        ui.horizontal(|ui| {
            strip.rate(ui);
            strip.frames(ui);
        });
        ui.horizontal(|ui| strip.save(ui));
    }
}

struct Strip<'a, 'b> {
    cx: &'a mut Context<'b>,
    path: &'a mut Path,
    timeline: &'a mut Timeline,
    on_path: bool,
}

impl Strip<'_, '_> {
    /// To the keys, to play, and where the playhead is.
    fn transport(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 3.0;
        let mut button = |ui: &mut Ui, icon, name, hover, command, enabled| {
            let response =
                ui.add_enabled_ui(enabled, |ui| icon_button(ui, icon, name, hover)).inner;
            if response.clicked() {
                self.cx.commands.push(command);
            }
            response
        };
        let (some, two) = (!self.path.is_empty(), self.path.keys.len() > 1);
        let hover = "To the key before (,)";
        button(ui, Icon::Previous, "Previous key", hover, Command::PreviousKey, some);
        let (icon, name, hover) = if self.timeline.is_playing() {
            (Icon::Pause, "Pause", "Stop here (Space)")
        } else {
            (Icon::Play, "Play", "Play the path, over and over (Space)")
        };
        let play = button(ui, icon, name, hover, Command::PlayPause, two);
        self.cx.rects.record("play", &play);
        button(ui, Icon::Next, "Next key", "To the next key (.)", Command::NextKey, some);
        ui.add_space(4.0);
        let text = if some {
            let frame = self.path.nearest_frame(self.timeline.secs());
            let last = self.path.frame_count().saturating_sub(1);
            format!("{:.2} s  ·  frame {frame} of {last}", self.timeline.secs())
        } else {
            "No keys yet".to_owned()
        };
        let hover = if !some {
            "Move the view, then add it as a key; the path goes from key to key"
        } else if self.on_path {
            "The playhead's time. The view shows this moment of the path"
        } else {
            "The view has left this moment of the path: add it as a key, update the key here, or move the playhead to come back"
        };
        let color = if some && !self.on_path { theme::ACCENT } else { theme::TEXT_DIM };
        ui.label(RichText::new(text).small().color(color)).on_hover_text(hover);
        ui.add_space(6.0);
    }

    /// What can be done with the view and the keys.
    fn keys(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 4.0;
        let here = self.path.key_at(self.timeline.secs());
        let full = self.path.keys.len() >= MAX_KEYS;
        let add = "Keep the view as a key: at the playhead or, where there is a key, 3 seconds after the last one (K)";
        let update = "Put the view in place of the key at the playhead (U)";
        let delete = "Delete the selected key (Del)";
        let selected = self.timeline.selected(self.path).is_some();
        for (name, hover, command, enabled) in [
            ("Add key", add, Command::AddKey, !full),
            ("Update key", update, Command::UpdateKey, here.is_some() && !self.on_path),
            ("Delete key", delete, Command::DeleteKey, selected),
        ] {
            let height = ui.spacing().interact_size.y;
            let button = Button::new(name).min_size(vec2(0.0, height));
            let response = ui.add_enabled(enabled, button);
            let response = response.on_hover_text(hover).on_disabled_hover_text(hover);
            if command == Command::AddKey {
                self.cx.rects.record("add key", &response);
            }
            if response.clicked() {
                self.cx.commands.push(command);
            }
        }
    }

    /// The selected key's time and easing.
    fn key_under_edit(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 4.0;
        if let Some(index) = self.timeline.selected(self.path) {
            label(ui, &format!("Key {}", index + 1), "The key under edit: the one selected last");
            let mut secs = self.path.keys[index].time_secs;
            let time = short_number(ui, 58.0, &KEY_TIME, &mut secs)
                .on_hover_text("When this key is reached, in seconds; between its neighbours");
            if time.changed() {
                self.timeline.retime(self.path, index, secs);
            }
            let key = &mut self.path.keys[index];
            for (easing, name, hover) in [
                (
                    Easing::Smooth,
                    "Smooth",
                    "On to the next key without a stop; from rest at the path's ends",
                ),
                (Easing::Linear, "Linear", "On to the next key at one speed"),
                (Easing::Hold, "Hold", "Stay until the next key, then cut"),
            ] {
                let chosen = key.easing == easing;
                let fill = if chosen { ui.visuals().selection.bg_fill } else { theme::RAISED };
                let height = ui.spacing().interact_size.y;
                let button =
                    Button::selectable(chosen, name).fill(fill).min_size(vec2(0.0, height));
                let response = ui.add(button).on_hover_text(hover);
                if response.accessible_name(format!("Easing: {name}")).clicked() {
                    key.easing = easing;
                }
            }
            ui.add_space(8.0);
        }
    }

    fn rate(&mut self, ui: &mut Ui) {
        label(ui, "Frame rate", FRAME_RATE.help);
        let mut rate = f64::from(self.path.frames_per_second);
        if short_number(ui, 40.0, &FRAME_RATE, &mut rate).on_hover_text(FRAME_RATE.help).changed() {
            // The field keeps to whole numbers of the range.
            self.path.frames_per_second = rate as u32;
        }
        ui.add_space(8.0);
    }

    /// Which frames to save.
    fn frames(&mut self, ui: &mut Ui) {
        let Some(last) = self.path.frame_count().checked_sub(1) else { return };
        let [mut first, mut end] = self.timeline.frames.unwrap_or([0, last]).map(|f| f.min(last));
        label(ui, "Frames", "The frames that Save sequence renders, from the first to the last");
        let edges = [("First frame", &mut first), ("Last frame", &mut end)];
        for (name, frame) in edges {
            if name == "Last frame" {
                label(ui, "to", "The last frame that is rendered");
            }
            let param = Param { label: name, max: f64::from(last), ..FRAME };
            let mut value = f64::from(*frame);
            let response = short_number(ui, 54.0, &param, &mut value);
            if response.on_hover_text(format!("{name} to render, 0 to {last}")).changed() {
                *frame = value as u32;
            }
        }
        end = end.max(first);
        self.timeline.frames = ([first, end] != [0, last]).then_some([first, end]);
        ui.add_space(8.0);
    }

    /// The button that saves them; while something is saved, how far it is.
    fn save(&mut self, ui: &mut Ui) {
        if let Some(progress) = self.cx.inputs.export {
            ui.allocate_ui(vec2(ui.available_width().clamp(120.0, 320.0), 40.0), |ui| {
                ui.vertical(|ui| export::saving(ui, self.cx, progress));
            });
            return;
        }
        let Some(last) = self.path.frame_count().checked_sub(1) else { return };
        let [first, end] = self.timeline.frames.unwrap_or([0, last]).map(|f| f.min(last));
        let (export, view_px) = (self.cx.settings.export, self.cx.view_px);
        let layout = self.cx.scene.camera.stereo.layout;
        let extent = export.text(view_px, layout);
        let count = end - first + 1;
        let text = RichText::new("Save sequence").color(theme::ON_ACCENT);
        let height_pt = ui.spacing().interact_size.y;
        let button = Button::new(text).fill(theme::ACCENT).min_size(vec2(0.0, height_pt));
        let response = ui.add(button).on_hover_text(format!(
            "Renders {count} frames of {extent} as PNGs in one zip. Other sizes: More, Export."
        ));
        self.cx.rects.record("save sequence", &response);
        if response.clicked() {
            self.cx.actions.push(Action::SaveSequence {
                size_px: export.resolve(view_px, layout),
                frames: [first, end + 1],
                pair: export.is_pair(layout),
            });
        }
    }
}

/// A number in a row of several, `width` points wide.
fn short_number(ui: &mut Ui, width: f32, param: &Param, value: &mut f64) -> Response {
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.push_id(param.label, |ui| ui.allocate_ui(size, |ui| number(ui, param, value)).inner).inner
}

fn label(ui: &mut Ui, text: &str, hover: &str) -> Response {
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM)).on_hover_text(hover)
}
