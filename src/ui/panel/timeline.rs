//! The timeline panel: a ruler to scrub, keys to drag, and commands on keys.

use egui::{Button, ComboBox, Response, RichText, Ui, vec2};

use super::{context::Context, export};
use crate::{
    scene::{
        Path,
        param::{Param, Scale, Unit},
        path::{Easing, FRAME_RATE, KEY_TIME, MAX_KEYS, SHUTTER},
    },
    ui::{
        action::Action,
        export_size::SequenceFormat,
        icon::{Icon, icon_button},
        shortcuts::Command,
        theme,
        timeline::Timeline,
        widgets::{Help as _, number, scrolled_row},
    },
};

mod track;

/// Minimum width of a strip with all buttons in one row, in points.
const ONE_ROW_FROM: f32 = 740.0;
/// The same with the larger buttons of touch screens.
const ONE_TOUCH_ROW_FROM: f32 = 920.0;

/// Height of a window, in points, below which a narrow strip has one row of buttons, which scrolls.
const LOW_WINDOW: f32 = 480.0;

/// Width of the progress of an export in a row that scrolls, in points: its longest time left stands beside its button.
const SCROLLED_PROGRESS_WIDTH: f32 = 270.0;

/// Width of the reason why a kind of video is missing, in points.
const REASON_WIDTH: f32 = 190.0;

/// A frame's number, at most that of the longest path at the highest frame rate.
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
pub fn strip(ui: &mut Ui, cx: &mut Context<'_>, path: &mut Path, timeline: &mut Timeline) {
    let on_path = timeline.was_on_path();
    let one_row_from = if theme::has_touch_rows(ui) { ONE_TOUCH_ROW_FROM } else { ONE_ROW_FROM };
    let wide = ui.available_width() >= one_row_from;
    let is_scrolled = !wide && ui.ctx().content_rect().height() < LOW_WINDOW;
    let mut strip = Strip { cx, path, timeline, on_path, is_scrolled };
    ui.spacing_mut().item_spacing.y = 4.0;
    ui.horizontal(|ui| {
        strip.transport(ui);
        if wide {
            strip.own_view_and_keys(ui);
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
        ui.horizontal(|ui| strip.key_and_saving(ui));
    } else if is_scrolled {
        ui.scope(|ui| {
            // Nothing else is here that a plain wheel could scroll.
            ui.style_mut().always_scroll_the_only_direction = true;
            scrolled_row(ui, "timeline row", |ui| {
                strip.own_view_and_keys(ui);
                strip.key_and_saving(ui);
            });
        });
    } else {
        ui.horizontal_wrapped(|ui| {
            strip.keys(ui);
            strip.own_view(ui);
        });
        if strip.timeline.selected(strip.path).is_some() {
            ui.horizontal(|ui| strip.selected_key(ui));
        }
        ui.horizontal(|ui| {
            strip.rate(ui);
            strip.frames(ui);
        });
        ui.horizontal(|ui| {
            strip.shutter(ui);
            strip.save(ui);
        });
    }
}

struct Strip<'a, 'b> {
    cx: &'a mut Context<'b>,
    path: &'a mut Path,
    timeline: &'a mut Timeline,
    on_path: bool,
    /// Whether the buttons are in one row that scrolls.
    is_scrolled: bool,
}

impl Strip<'_, '_> {
    /// The buttons of the view and of keys, in one row.
    fn own_view_and_keys(&mut self, ui: &mut Ui) {
        self.own_view(ui);
        self.keys(ui);
    }

    /// The selected key, and how the frames are rendered and saved, in one row.
    fn key_and_saving(&mut self, ui: &mut Ui) {
        self.selected_key(ui);
        self.rate(ui);
        self.shutter(ui);
        self.frames(ui);
        self.save(ui);
    }

    /// Buttons for previous key, play and next key, and the playhead's time.
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
        let hover = "Go to the previous key (,)";
        button(ui, Icon::Previous, "Previous key", hover, Command::PreviousKey, some);
        let (icon, name, hover) = if self.timeline.is_playing() {
            (Icon::Pause, "Pause", "Pause (Space)")
        } else {
            (Icon::Play, "Play", "Play the path in a loop (Space)")
        };
        let play = button(ui, icon, name, hover, Command::PlayPause, two);
        self.cx.rects.record("play", &play);
        button(ui, Icon::Next, "Next key", "Go to the next key (.)", Command::NextKey, some);
        ui.add_space(4.0);
        let text = if some {
            let frame = self.path.nearest_frame(self.timeline.secs());
            let last = self.path.frame_count().saturating_sub(1);
            let place = if frame > last {
                "after the last key".to_owned()
            } else {
                format!("frame {frame} of {last}")
            };
            format!("{:.2} s  ·  {place}", self.timeline.secs())
        } else {
            "No keys yet".to_owned()
        };
        let hover = if !some {
            "Move the view, then add it as a key. Playback moves from key to key."
        } else if self.on_path {
            "The playhead's time. The view shows the path at this time."
        } else {
            "The view is your own, not the path's. It stays until you add it as a key, update the key, or return to the path."
        };
        let color = if some && !self.on_path { theme::ACCENT } else { theme::TEXT_DIM };
        ui.label(RichText::new(text).small().color(color)).help(hover);
        ui.add_space(6.0);
    }

    /// Buttons that show the path, or a view of the user's own.
    fn own_view(&mut self, ui: &mut Ui) {
        let button = |ui: &mut Ui, name, hover| {
            let height = ui.spacing().interact_size.y;
            ui.add(Button::new(name).min_size(vec2(0.0, height))).help(hover).clicked()
        };
        if !self.path.is_empty() && !self.on_path && !self.timeline.is_playing() {
            let hover =
                "Show the path at the playhead. Your view is put aside, and you can have it back.";
            if button(ui, "Return to path", hover) {
                self.timeline.return_to_path();
            }
        }
        if self.timeline.has_own_view_aside() {
            let hover = "Show the view again that you had before the path was shown";
            if button(ui, "Return to my view", hover) {
                self.timeline.return_to_own_view();
            }
        }
    }

    /// Buttons to add, update and delete keys, and to make all of them.
    fn keys(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 4.0;
        let here = self.path.key_at(self.timeline.secs());
        let full = self.path.keys.len() >= MAX_KEYS;
        let add = "Add the view and all settings as a key at the playhead. If a key is there, the new key follows the last one after 3 seconds (K).";
        let update = "Replace the key at the playhead by the view (U)";
        let delete = "Delete the selected key (Del)";
        let turntable = "Make a path once around the scene in 12 seconds, instead of the present one. It repeats without a seam.";
        let selected = self.timeline.selected(self.path).is_some();
        for (name, hover, command, enabled) in [
            ("Add key", add, Command::AddKey, !full),
            ("Update key", update, Command::UpdateKey, here.is_some() && !self.on_path),
            ("Delete key", delete, Command::DeleteKey, selected),
            ("Turntable", turntable, Command::Turntable, true),
        ] {
            let height = ui.spacing().interact_size.y;
            let button = Button::new(name).min_size(vec2(0.0, height));
            let response = ui.add_enabled(enabled, button);
            let response = response.help(hover).disabled_help(hover);
            if command == Command::AddKey {
                self.cx.rects.record("add key", &response);
            }
            if response.clicked() {
                self.cx.commands.push(command);
            }
        }
    }

    /// The selected key's time and easing.
    fn selected_key(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 4.0;
        if let Some(index) = self.timeline.selected(self.path) {
            label(ui, &format!("Key {}", index + 1), "The selected key");
            let mut secs = self.path.keys[index].time_secs;
            let time = short_number(ui, 58.0, &KEY_TIME, &mut secs)
                .help("The time of this key, in seconds; between its neighbours");
            if time.changed() {
                self.timeline.retime(self.path, index, secs);
            }
            let key = &mut self.path.keys[index];
            for (easing, name, hover) in [
                (
                    Easing::Smooth,
                    "Smooth",
                    "Moves smoothly through the keys; starts and stops gently at the path's ends",
                ),
                (Easing::Linear, "Linear", "Moves to the next key at constant speed"),
                (Easing::Hold, "Hold", "Stays until the next key, then jumps"),
            ] {
                let chosen = key.easing == easing;
                let fill = if chosen { ui.visuals().selection.bg_fill } else { theme::RAISED };
                let height = ui.spacing().interact_size.y;
                let button =
                    Button::selectable(chosen, name).fill(fill).min_size(vec2(0.0, height));
                let response = ui.add(button).help(hover);
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
        if short_number(ui, 40.0, &FRAME_RATE, &mut rate).help(FRAME_RATE.help).changed() {
            // The field only accepts whole numbers in the range.
            self.path.frames_per_second = rate as u32;
        }
        ui.add_space(8.0);
    }

    fn shutter(&mut self, ui: &mut Ui) {
        label(ui, SHUTTER.label, SHUTTER.help);
        short_number(ui, 40.0, &SHUTTER, &mut self.path.shutter).help(SHUTTER.help);
        ui.add_space(8.0);
    }

    /// The range of frames to save.
    fn frames(&mut self, ui: &mut Ui) {
        let Some(last) = self.path.frame_count().checked_sub(1) else { return };
        let [mut first, mut end] = self.timeline.frames.unwrap_or([0, last]).map(|f| f.min(last));
        label(ui, "Frames", "The first and the last frame that Save sequence renders");
        let edges = [("First frame", &mut first), ("Last frame", &mut end)];
        for (name, frame) in edges {
            if name == "Last frame" {
                label(ui, "to", "The last frame to render");
            }
            let param = Param { label: name, max: f64::from(last), ..FRAME };
            let mut value = f64::from(*frame);
            let response = short_number(ui, 54.0, &param, &mut value);
            if response.help(format!("{name} to render, 0 to {last}")).changed() {
                *frame = value as u32;
            }
        }
        end = end.max(first);
        self.timeline.frames = ([first, end] != [0, last]).then_some([first, end]);
        ui.add_space(8.0);
    }

    /// The choice between a video and pictures.
    fn format(&mut self, ui: &mut Ui) {
        let missing = self.cx.inputs.missing_encoders;
        let chosen = &mut self.cx.settings.export.sequence;
        let shown_format = chosen.or_encodable(missing);
        let name = |format| {
            SequenceFormat::ALL.iter().find(|(of, ..)| *of == format).map_or("", |it| it.1)
        };
        let shown = ComboBox::from_id_salt("kind of file")
            .width(64.0)
            .selected_text(name(shown_format))
            .show_ui(ui, |ui| {
                let offered = SequenceFormat::ALL.iter().filter(|it| !missing.contains(it.0));
                for &(format, name, hover) in offered {
                    let is_shown = format == shown_format;
                    // Only a pointer's click closes the menu by itself.
                    if ui.selectable_label(is_shown, name).help(hover).clicked() {
                        *chosen = format;
                        ui.close();
                    }
                }
                if let Some(reason) = missing.text() {
                    ui.set_min_width(REASON_WIDTH);
                    ui.label(RichText::new(reason).small().color(theme::TEXT_DIM));
                }
            });
        let response = shown.response.accessible_name("Kind of file");
        self.cx.rects.record("kind of file", &response);
        response.help("Whether the frames become a video, MP4 or WebM, or pictures, PNGs");
    }

    /// The button that saves the frames, or the progress of an export.
    fn save(&mut self, ui: &mut Ui) {
        if let Some(progress) = self.cx.inputs.export {
            // The panel shows the progress of all exports, while it is open.
            if self.cx.settings.panel_open {
                ui.add_enabled(false, Button::new("Saving…"));
                return;
            }
            // A row that scrolls has room for all of it.
            let least = if self.is_scrolled { SCROLLED_PROGRESS_WIDTH } else { 120.0 };
            let width = ui.available_width().clamp(least, 320.0);
            ui.allocate_ui(vec2(width, 40.0), |ui| {
                ui.vertical(|ui| export::saving(ui, self.cx, progress));
            });
            return;
        }
        let Some(last) = self.path.frame_count().checked_sub(1) else { return };
        self.format(ui);
        let [first, end] = self.timeline.frames.unwrap_or([0, last]).map(|f| f.min(last));
        let (mut export, view_px) = (self.cx.settings.export, self.cx.view_px);
        export.sequence = export.sequence.or_encodable(self.cx.inputs.missing_encoders);
        // A video has both eyes' pictures in each frame.
        export.pair &= !export.sequence.is_video();
        let layout = self.cx.scene.camera.stereo.layout;
        let extent = export.text(view_px, layout);
        let count = end - first + 1;
        let (name, kind) = match export.sequence {
            SequenceFormat::Mp4 => ("Save video", "an MP4 video"),
            SequenceFormat::WebM => ("Save video", "a WebM video"),
            SequenceFormat::Pngs => ("Save frames", "PNGs in one zip file"),
        };
        let text = RichText::new(name).color(theme::ON_ACCENT);
        let height_pt = ui.spacing().interact_size.y;
        let button = Button::new(text).fill(theme::ACCENT).min_size(vec2(0.0, height_pt));
        let response = ui.add(button).help(format!(
            "Renders {count} frames of {extent} as {kind}. For other sizes, see More, Export."
        ));
        self.cx.rects.record("save sequence", &response);
        if response.clicked() {
            self.cx.actions.push(Action::SaveSequence {
                size_px: export.resolve(view_px, layout),
                frames: [first, end + 1],
                format: export.sequence,
                pair: export.is_pair(layout),
            });
        }
    }
}

/// A number field, `width` points wide where there are no fingers.
fn short_number(ui: &mut Ui, width: f32, param: &Param, value: &mut f64) -> Response {
    let size = vec2(theme::target_size(ui, width), ui.spacing().interact_size.y);
    ui.push_id(param.label, |ui| ui.allocate_ui(size, |ui| number(ui, param, value)).inner).inner
}

fn label(ui: &mut Ui, text: &str, hover: &str) -> Response {
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM)).help(hover)
}
