//! The picture's part of a frame: its camera's input, and what lies over it.

use egui::{Align2, Button, Key, Rect, Response, Sense, Ui, vec2};

use super::{Interface, NO_EARLIER_VIEW};
use crate::scene::Project;
use crate::ui::{
    display_inputs::DisplayInputs,
    dive,
    floating::{self, ButtonRow, CaptionArea, RowButton},
    frame::Frame,
    handles,
    home::HomeTarget,
    icon::Icon,
    light_click,
    navigation::guide::GuideStatus,
    panel,
    places::{self, PinInputs},
    shortcuts::{self, Command},
    slice::Slice,
    theme, view,
    widgets::Help as _,
};

impl Interface {
    /// Draws the picture and applies input to its camera.
    ///
    /// `is_reshaped` is true if this frame's panels changed the fractal.
    pub(super) fn view(
        &mut self,
        ui: &mut Ui,
        inputs: &DisplayInputs<'_>,
        wide: bool,
        is_reshaped: bool,
        commands: &mut Vec<Command>,
    ) {
        let area = ui.available_rect_before_wrap();
        let (rect, size_px) = view::snap_to_pixels(area, ui.ctx().pixels_per_point());
        self.view_px = size_px;
        let frame = Frame { rect, height_px: size_px[1] };
        self.frame = Some(frame);
        let scene = self.editor.scene_mut();
        if let Some(before) = self.camera_status.filter(|_| is_reshaped) {
            self.pilot.keep_framed(scene, frame, before);
        }
        let is_stereo = scene.camera.stereo.is_on();
        let response = view::show(ui, frame, inputs.picture, inputs.kept_picture, is_stereo);
        self.rects.record("view", &response);
        // The buttons precede the pilot, which executes this frame's commands.
        let buttons = self.buttons(ui, rect, commands);
        let is_comparing = self.is_comparing && self.editor.can_undo();
        let is_covered = self.is_covered(ui.ctx(), inputs);
        let scene = self.editor.scene_mut();
        // A drag belongs to the eye's picture in which it began.
        let pointer = ui.input(|i| i.pointer.press_origin().or(i.pointer.latest_pos()));
        let frame = frame.of_eye(scene.camera.stereo.layout, pointer);
        self.pilot.draw_to_places(self.settings.drawn_to_places);
        let before = scene.camera.clone();
        self.pilot.move_camera(ui, &response, frame, scene, &self.home, commands);
        if let Some(at) = self.light_click.asked(ui, &response, frame.rect.center())
            && let Some(place) = self.pilot.lit_place(scene, frame, at)
        {
            self.selection.light = Some(light_click::light(scene, self.selection.light, &place));
        }
        let (is_zoom, is_held) = ui.input(|i| {
            let is_zoom = i.is_scrolling() || i.multi_touch().is_some();
            (is_zoom, i.pointer.any_down())
        });
        if is_zoom || is_held {
            self.settings.hints.note(&before, &scene.camera, is_zoom);
        }
        let has_record = self.pilot.dive_record().len() > 1;
        let captions = CaptionArea::new(rect, buttons.area(rect));
        let status = self.pilot.guide_status();
        let of_dive = dive::show(ui, captions, status, has_record, &mut self.rects, commands);
        let captions = of_dive.map_or(captions, |shown| captions.above(&shown));
        if is_comparing {
            let caption = floating::caption(ui, captions, "Before the last change");
            self.rects.record("comparing", &caption);
        } else if let Some(name) = self.look_preview.name() {
            let caption = floating::caption(ui, captions, &format!("Preview: {name}"));
            self.rects.record("look preview", &caption);
        } else if self.light_click.waits() {
            let by_keyboard = response.has_focus();
            let hint = if by_keyboard { light_click::KEYBOARD_HINT } else { light_click::HINT };
            let caption = floating::caption(ui, captions, hint);
            self.rects.record("light click", &caption);
        } else if self.pilot.is_flying() {
            // A narrow window on a desktop has the rows of a touch screen, but no fingers.
            let has_fingers = ui.input(|input| input.has_touch_screen());
            let help = shortcuts::flight_help(has_fingers);
            let caption = if has_fingers {
                let hover = ("Stop flying", "Leave fly mode (F)");
                let (caption, stop) = floating::caption_with_button(ui, captions, &help, hover);
                if stop.clicked() {
                    commands.push(Command::ToggleFlight);
                }
                caption
            } else {
                floating::caption(ui, captions, &help)
            };
            self.rects.record("fly keys", &caption);
        } else {
            let hint = if is_covered {
                None
            } else {
                self.settings.hints.show(ui, captions, self.has_touch)
            };
            if let Some(hint) = hint {
                self.rects.record("hint", &hint);
            }
        }
        let is_previewing = self.look_preview.name().is_some();
        if !(is_comparing || is_previewing || self.pilot.is_flying()) {
            let light = handles::point_lights(ui, frame, scene, &self.selection);
            self.selection.light = light.or(self.selection.light);
            let is_in_use = self.selection.uses_lights || self.light_click.waits();
            if panel::shows_lights(&self.settings) || self.light_handles.are_shown(ui, is_in_use) {
                let used = handles::environment_lights(ui, frame, scene, &self.selection);
                self.selection.light = used.touched.or(self.selection.light);
                if used.is_held {
                    self.light_handles.keep(ui);
                }
            }
            if panel::shows_section_planes(&self.settings) {
                handles::section_planes(ui, frame, scene);
            }
        }
        self.selection.moved_light = None;
        self.selection.uses_lights = false;
        self.camera_status = Some(self.pilot.camera_status(scene, frame));
        let is_moving = self.timeline.is_playing()
            || self.pilot.is_moving(ui.input(|i| i.time))
            || self.pilot.speed() > 0.0;
        let model = self.pilot.models().of(&scene.fractal);
        let mut now_ms = self.clock.0;
        let mut slice = Slice::of(ui.input(|i| i.stable_dt), &mut now_ms);
        self.places.advance(scene, &model, frame, is_moving, &mut slice);
        self.places.request_repaint(ui);
        let mut toggle = Rect::NOTHING;
        if wide && !self.settings.panel_open {
            let at = rect.right_top() + vec2(-10.0 - floating::button_side(ui), 10.0);
            let hover = ("Show panel", "Show the panel (P)");
            let button = floating::button(ui, at, Icon::Controls, hover);
            self.rects.record("panel toggle", &button);
            toggle = button.rect;
            if button.clicked() {
                commands.push(Command::TogglePanel);
            }
        }
        let pins = PinInputs {
            frame,
            camera: &scene.camera,
            textures: inputs.small_pictures,
            buttons: [buttons.area(rect), toggle],
        };
        let chosen = places::show(ui, &mut self.places, &pins, &mut self.rects);
        if let Some(pin) = chosen.and_then(|index| self.places.pins().get(index)) {
            self.pilot.fly_to(scene, frame, pin.place.field(), &pin.to);
            self.places.put_away();
            ui.ctx().request_repaint();
        }
        if inputs.picture.is_none() && inputs.kept_picture.is_none() {
            ui.painter().text(
                rect.center(),
                Align2::CENTER_CENTER,
                "Preparing the first picture…",
                egui::FontId::proportional(15.0),
                theme::TEXT_DIM,
            );
        }
        let scene = self.editor.scene();
        let textures = inputs.small_pictures;
        if let Some(chosen) = self.mutate.show(ui, rect, scene, textures, &mut self.rects) {
            let path = self.project().path.clone();
            self.editor.replace(Project { scene: chosen, path });
        }
        ui.allocate_rect(area, egui::Sense::hover());
    }

    /// True if a window, a message or another caption may lie where a hint would be.
    fn is_covered(&self, ctx: &egui::Context, inputs: &DisplayInputs<'_>) -> bool {
        let is_saving_shown = inputs.export.is_some() && self.rects.get("cancel export").is_none();
        let has_message = inputs.notice.is_some() || inputs.reading.is_some() || is_saving_shown;
        let is_over_picture = self.mutate.is_open() || self.share.is_open() || self.compare.is_on();
        let is_over_window = self.help_open || self.finder.is_open();
        let has_caption = self.places.are_shown() || self.pilot.guide_status() != GuideStatus::Idle;
        has_message
            || is_over_picture
            || is_over_window
            || has_caption
            || panel::is_formula_window_open(ctx)
    }

    /// The buttons in the picture's lower left corner; none over the variations.
    fn buttons(&mut self, ui: &mut Ui, rect: Rect, commands: &mut Vec<Command>) -> ButtonRow {
        let mut buttons = ButtonRow::new(ui, rect);
        if self.mutate.is_open() {
            return buttons;
        }
        let tools = self.tools();
        let capacity = ButtonRow::capacity(ui, rect);
        let in_row = if tools.len() > capacity { capacity - 1 } else { tools.len() };
        let (in_row, in_menu) = tools.split_at(in_row);
        for tool in in_row {
            let add = |ui: &mut Ui| buttons.add(ui, tool.button);
            let button = ui.add_enabled_ui(tool.is_enabled, add).inner;
            self.rects.record(tool.rect, &button);
            let is_on = match tool.command {
                Command::FindPlaces => self.places.are_shown(),
                Command::Compare => self.compare.is_on(),
                _ => false,
            };
            if is_on {
                floating::mark(ui, &button);
            }
            self.use_tool(ui, tool, &button, commands);
        }
        if !in_menu.is_empty() {
            let hover = ("More tools", "Shows the tools that do not fit in this row");
            let more = buttons
                .add(ui, RowButton { icon: Icon::More, name_and_hover: hover, word: "More" });
            self.rects.record("more tools", &more);
            self.menu_of_tools(ui, &more, in_menu, commands);
        }
        buttons
    }

    /// Shows `tools` in a menu above `more`. A menu that had the keyboard focus returns it to `more` when it closes.
    fn menu_of_tools(
        &mut self,
        ui: &Ui,
        more: &Response,
        tools: &[Tool],
        commands: &mut Vec<Command>,
    ) {
        let size = vec2(120.0, floating::button_side(ui));
        let menu = egui::Popup::menu(more);
        let (id, was_open) = (menu.get_id(), menu.is_open());
        let mut has_focus = more.has_focus();
        menu.align(egui::RectAlign::TOP_END)
            .close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside)
            .show(|ui| {
                for tool in tools {
                    let (name, hover) = tool.button.name_and_hover;
                    let button = Button::new(tool.button.word).min_size(size);
                    let button = ui.add_enabled(tool.is_enabled, button).accessible_name(name);
                    let button = button.help(hover).disabled_help(hover);
                    has_focus |= button.has_focus();
                    self.rects.record(tool.rect, &button);
                    if self.use_tool(ui, tool, &button, commands) {
                        ui.close();
                    }
                }
            });
        let is_closed = was_open && !egui::Popup::is_id_open(ui.ctx(), id);
        let is_by_pointer = ui.input(|i| i.pointer.any_pressed() || i.pointer.any_released());
        // Escape takes the focus before the frame that closes the menu.
        let was_inside = has_focus || self.tool_menu_focus == MenuFocus::Inside;
        if is_closed && was_inside && !is_by_pointer {
            self.tool_menu_focus = MenuFocus::Due;
        } else if self.tool_menu_focus != MenuFocus::Due {
            self.tool_menu_focus = if has_focus { MenuFocus::Inside } else { MenuFocus::Elsewhere };
        } else if !ui.input(|i| i.key_down(Key::Enter) || i.key_down(Key::Space)) {
            // A key that is still down would open the menu again.
            more.request_focus();
            self.tool_menu_focus = MenuFocus::Elsewhere;
        }
        if self.tool_menu_focus == MenuFocus::Due {
            ui.ctx().request_repaint();
        }
    }

    /// Runs the command of a clicked tool, and returns whether it ran. A pointer shows the view before the last change
    /// while it is down; Enter or a screen reader's click runs the command, which lasts two seconds. The command of a
    /// disabled tool runs at a press: it says why it does nothing.
    fn use_tool(
        &mut self,
        ui: &Ui,
        tool: &Tool,
        button: &Response,
        commands: &mut Vec<Command>,
    ) -> bool {
        if !tool.is_enabled {
            // egui gives a press on a disabled button to what lies below it: here the picture, which would turn.
            let id = button.id.with("disabled");
            let press = ui.interact(button.rect, id, Sense::CLICK | Sense::DRAG);
            let is_pressed =
                press.is_pointer_button_down_on() && ui.input(|i| i.pointer.any_pressed());
            commands.extend(is_pressed.then_some(tool.command));
            return is_pressed;
        }
        let is_by_pointer = button.ctx.input(|input| input.pointer.any_released());
        self.is_comparing |= tool.is_held && button.is_pointer_button_down_on();
        let is_run = button.clicked() && !(tool.is_held && is_by_pointer);
        if is_run {
            commands.push(tool.command);
        }
        is_run
    }

    /// The tools over the picture, the most used first.
    fn tools(&self) -> Vec<Tool> {
        let tool = |icon, name_and_hover, word, rect, command| Tool {
            button: RowButton { icon, name_and_hover, word },
            rect,
            command,
            is_held: false,
            is_enabled: true,
        };
        let mut tools = Vec::new();
        let hover = ("Surprise me", "Show a random scene (R)");
        tools.push(tool(Icon::Dice, hover, "Surprise", "surprise", Command::Surprise));
        let hover = ("Mutate", "Show variations of this scene, side by side (M)");
        tools.push(tool(Icon::Grid, hover, "Mutate", "mutate", Command::Mutate));
        let hover = ("Share", "Share this view: a link, a QR code, the picture (J)");
        tools.push(tool(Icon::Share, hover, "Share", "share", Command::Share));
        let pins = self.places.button();
        tools.push(tool(Icon::Pin, pins, "Places", "find places", Command::FindPlaces));
        let (hover, word) =
            if self.pilot.is_diving() { (dive::STOP, "Stop") } else { (dive::BEGIN, "Dive") };
        tools.push(tool(Icon::Dive, hover, word, "dive", Command::Dive));
        if let Some(target) = HomeTarget::of(&self.editor.scene().camera, &self.home) {
            let (icon, hover) = target.button();
            tools.push(tool(icon, hover, hover.0, "home", Command::Home));
        }
        if !self.settings.timeline_open {
            let hover =
                ("Animate", "Show the timeline: animate the camera and all settings with keys (T)");
            let command = Command::ToggleTimeline;
            // On a phone, where few tools fit, others are used more.
            let at = if self.has_touch { tools.len() } else { 0 };
            let animate = tool(Icon::Timeline, hover, "Animate", "timeline toggle", command);
            tools.insert(at, animate);
        }
        let hover = if self.compare.is_on() {
            ("Compare", "Switch between the states A and B (Shift C)")
        } else {
            ("Compare", "Keep this state as A and edit a copy, B (Shift C)")
        };
        let compare = Command::Compare;
        tools.push(tool(Icon::Halves, hover, "Compare", "compare toggle", compare));
        let is_enabled = self.editor.can_undo();
        let hover = if is_enabled {
            "Hold to see the view before the last change (hold C); Enter shows that view for two seconds"
        } else {
            NO_EARLIER_VIEW
        };
        let hover = ("Before", hover);
        let before = tool(Icon::Before, hover, "Before", "before", Command::ShowBefore);
        tools.push(Tool { is_held: true, is_enabled, ..before });
        tools
    }
}

/// Where the keyboard focus is, as the menu of tools sees it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum MenuFocus {
    /// Neither in the menu nor at its button.
    #[default]
    Elsewhere,
    /// In the menu or at its button.
    Inside,
    /// Lost with the closed menu: its button gets it.
    Due,
}

/// A tool over the picture.
struct Tool {
    button: RowButton,
    /// The name of its rectangle.
    rect: &'static str,
    /// What a click runs.
    command: Command,
    /// True if a pointer uses the tool by holding it down, not by a click.
    is_held: bool,
    is_enabled: bool,
}
