//! One frame of the interface: layout and undo. Commands run in `dispatch`. The picture's part is in `picture`, the opening of
//! other scenes in `scenes`, the camera path in `paths`, what the finder leads to in `finding`.

mod dispatch;
mod finding;
mod paths;
mod picture;
mod scenes;

use std::sync::Arc;

use egui::{Margin, Panel, Ui};

use super::{
    action::Action,
    compare::Compare,
    control_index::ControlIndex,
    display_inputs::{DisplayInputs, Notice},
    editor::Editor,
    favourites::{Favourite, Favourites},
    finder::Finder,
    frame::Frame,
    light_click::LightClick,
    light_handles::LightHandles,
    loaded::Loaded,
    look_preview::LookPreview,
    mutate::Mutate,
    navigation::CameraStatus,
    notice,
    panel::{self, Context, PanelPart},
    pilot::Pilot,
    places::Places,
    rects::Rects,
    selection::Selection,
    settings::Settings,
    share::Share,
    shortcuts::{self, Command},
    slice::Clock,
    small_picture::SmallPicture,
    status,
    surprises::Surprises,
    theme,
    timeline::Timeline,
    toast::Toast,
    view, widgets,
};
use crate::{
    fractal::SharedModel,
    scene::{Camera, EnvironmentMap, Project, Scene, gradient::NamedGradient},
};

/// Pause within a gesture after which the view counts as still and is refined.
const STILL_SECS: f64 = 0.25;
/// Seconds for which [`Command::ShowBefore`] shows the view before the last change.
const BEFORE_SECS: f64 = 2.0;

/// Why [`Command::ShowBefore`] shows nothing.
const NO_EARLIER_VIEW: &str = "There is no earlier view.";

/// Seconds for which a notice of the interface itself stays.
const NOTICE_SECS: f64 = 6.0;

/// The user interface and the edited project.
#[derive(Debug)]
pub struct Interface {
    editor: Editor,
    settings: Settings,
    selection: Selection,
    favourites: Favourites,
    pilot: Pilot,
    places: Places,
    timeline: Timeline,
    /// The target of Home.
    home: Camera,
    sheet: panel::Sheet,
    share: Share,
    light_click: LightClick,
    light_handles: LightHandles,
    compare: Compare,
    finder: Finder,
    control_index: ControlIndex,
    toast: Toast,
    mutate: Mutate,
    surprises: Surprises,
    look_preview: LookPreview,
    help_open: bool,
    /// True if the screen is used with fingers.
    has_touch: bool,
    /// True if a text field had the keyboard at the end of the last frame: egui takes the focus from it before a frame
    /// with the Escape key.
    was_typing: bool,
    camera_status: Option<CameraStatus>,
    rects: Rects,
    view_px: [u32; 2],
    /// Where the picture was in the last frame.
    frame: Option<Frame>,
    moving: bool,
    /// True while the view before the last change is shown.
    is_comparing: bool,
    /// Time until which the view before the last change is shown by [`Command::ShowBefore`], on egui's clock.
    before_until_secs: f64,
    /// Where the keyboard focus was in the last frame, as the menu of tools sees it.
    tool_menu_focus: picture::MenuFocus,
    histogram_shown: bool,
    loaded: Loaded,
    /// Ends the slices of searches.
    clock: Clock,
}

impl Interface {
    /// An interface that edits a scene or a project; the view starts at the scene's camera.
    pub fn new(project: impl Into<Project>, settings: Settings) -> Self {
        let project = project.into();
        Self {
            home: project.scene.camera.clone(),
            editor: Editor::new(project),
            settings,
            selection: Selection::default(),
            favourites: Favourites::default(),
            pilot: Pilot::default(),
            places: Places::default(),
            timeline: Timeline::default(),
            sheet: panel::Sheet::default(),
            share: Share::default(),
            light_click: LightClick::default(),
            light_handles: LightHandles::default(),
            compare: Compare::default(),
            finder: Finder::default(),
            control_index: ControlIndex::default(),
            toast: Toast::default(),
            mutate: Mutate::default(),
            surprises: Surprises::default(),
            look_preview: LookPreview::default(),
            help_open: false,
            has_touch: false,
            was_typing: false,
            camera_status: None,
            rects: Rects::default(),
            view_px: [1, 1],
            frame: None,
            moving: false,
            is_comparing: false,
            before_until_secs: 0.0,
            tool_menu_focus: picture::MenuFocus::default(),
            histogram_shown: false,
            loaded: Loaded::default(),
            clock: Clock::default(),
        }
    }

    /// Replaces the clock that ends slices of searches, in milliseconds, so that a test repeats exactly.
    pub fn set_clock(&mut self, clock_ms: fn() -> f64) {
        self.clock = Clock(clock_ms);
        self.pilot.set_clock(self.clock);
    }

    /// The fractal by which movements are measured, to share with the view that draws it.
    pub fn models(&self) -> &SharedModel {
        self.pilot.models()
    }

    /// The current scene.
    pub fn scene(&self) -> &Scene {
        self.editor.scene()
    }

    /// The scene to draw: the current one, the one before the last change while they are compared, or the current
    /// one in the look that is pointed at.
    pub fn shown_scene(&self) -> &Scene {
        let before = self.editor.steps().next().filter(|_| self.is_comparing);
        let shown = before.map(|project| &project.scene).or(self.look_preview.scene());
        shown.unwrap_or(self.scene())
    }

    /// The current scene and path.
    pub fn project(&self) -> &Project {
        self.editor.project()
    }

    /// Replaces the project as one undo step. The new camera becomes the target of Home.
    pub fn replace_project(&mut self, project: impl Into<Project>) {
        let project = project.into();
        self.home = project.scene.camera.clone();
        self.editor.replace(project);
        self.pilot.cancel();
        self.timeline.stop();
    }

    /// Lights the scene by a loaded environment map, as one undo step.
    ///
    /// [`Scene::surround_by`] describes the changes of the scene.
    pub fn use_environment_map(&mut self, environment_map: Arc<EnvironmentMap>) {
        self.loaded.use_environment_map(&mut self.editor, environment_map);
    }

    /// Lists the gradients of a file under Colours, and colours the surface with the first, as one undo step.
    pub fn use_gradients(&mut self, gradients: Vec<NamedGradient>) {
        let layer = self.selection.gradient_target;
        self.loaded.use_gradients(&mut self.editor, layer, gradients);
    }

    /// The loaded environment map, if the scene names it.
    pub fn environment_map(&self) -> Option<&Arc<EnvironmentMap>> {
        self.loaded.environment_map(self.scene())
    }

    /// Width and height of the view, in pixels.
    pub fn view_size_px(&self) -> [u32; 2] {
        self.view_px
    }

    /// True if further changes are expected: during a drag, a flight, or wheel notches.
    pub fn is_moving(&self) -> bool {
        self.moving
    }

    /// True if the film's histogram is visible and must be computed.
    pub fn wants_histogram(&self) -> bool {
        self.histogram_shown
    }

    /// The small pictures to draw when idle, the first ones first.
    pub fn small_pictures(&self) -> impl Iterator<Item = &SmallPicture> + Clone {
        self.places.small_pictures().chain(self.mutate.small_pictures())
    }

    /// The positions of named widgets.
    pub fn rects(&self) -> &Rects {
        &self.rects
    }

    /// Keeps a view with its small picture, a JPEG file.
    pub fn keep_favourite(&mut self, document: String, jpeg: Vec<u8>) {
        let name = self.favourites.free_name();
        self.favourites.keep(Favourite::new(name, document, jpeg));
    }

    /// The kept views, to restore and to store them.
    pub fn favourites_mut(&mut self) -> &mut Favourites {
        &mut self.favourites
    }

    /// The settings to store until the next visit.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The settings, to take in what another tab has stored.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.settings
    }

    /// The editor, for its project and history.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// The editor, for undo and redo by the shell.
    pub fn editor_mut(&mut self) -> &mut Editor {
        &mut self.editor
    }

    /// Draws one frame over all of `ui` and returns the requests to the shell.
    ///
    /// Afterwards the scene, the view's size and [`Self::is_moving`] are up to date.
    pub fn show(&mut self, ui: &mut Ui, inputs: &DisplayInputs<'_>) -> Vec<Action> {
        let now_secs = ui.input(|i| i.time);
        let (pressed, held) =
            ui.input(|i| (i.pointer.any_pressed(), i.pointer.any_down() || i.any_touches()));
        if pressed || !(held || self.pilot.is_moving(now_secs)) {
            self.editor.next_gesture();
        }
        let before = self.project().clone();
        self.timeline.begin(&before, self.settings.timeline_open);
        self.rects.clear();
        let mut commands =
            shortcuts::commands(ui.ctx(), self.pilot.is_flying(), view::has_focus(ui.ctx()));
        let mut actions = Vec::new();

        let wide = theme::has_side_panel(ui.available_size());
        // Before the first touch, egui does not know that the screen is one.
        self.has_touch = !wide || ui.input(|input| input.has_touch_screen());
        let before_left_secs = self.before_until_secs - now_secs;
        let holds_before = shortcuts::is_comparing(ui.ctx());
        if holds_before && !self.is_comparing && !self.editor.can_undo() {
            self.show_notice(NO_EARLIER_VIEW, now_secs);
        }
        self.is_comparing = holds_before || before_left_secs > 0.0;
        if before_left_secs > 0.0 {
            // In every frame: egui keeps one time at most, that of the last frame.
            ui.ctx().request_repaint_after_secs(before_left_secs as f32);
        }
        self.pilot.set_jumps(inputs.reduced_motion);
        theme::set_motion(ui.ctx(), !inputs.reduced_motion);
        theme::set_row_sizes(ui, self.has_touch);
        self.panels(ui, inputs, wide, &mut commands, &mut actions);
        self.status(ui, inputs);
        // A panel that changes the camera as well has framed the fractal itself.
        let Scene { fractal, camera, .. } = self.scene();
        let is_reshaped = *fractal != before.scene.fractal && *camera == before.scene.camera;
        self.view(ui, inputs, wide, is_reshaped, &mut commands);
        let view = self.rects.get("view");
        let other_state = view.and_then(|view| self.compare.show(ui, view, &mut self.rects));
        self.notices(ui, inputs, now_secs, &mut actions);
        panel::help_window(ui.ctx(), &mut self.help_open, self.has_touch, &mut self.rects);
        if let Some(view) = view {
            let project = self.editor.project();
            let shared = self.share.show(ui, view, project, inputs.sharing, &mut self.rects);
            commands.extend(shared);
        }

        let (project, settings) = (self.editor.project(), &self.settings);
        let controls = || self.control_index.controls(project, settings, inputs);
        if let Some(target) = self.finder.show(ui, &mut self.rects, controls) {
            self.show_target(ui, target, wide, &mut commands);
        }
        if widgets::focus_named(ui.ctx()).is_some() {
            self.show_notice("This scene has no such control.", now_secs);
        }
        let applies = |command| self.settings.timeline_open || command == Command::AddKey;
        for command in commands.iter().copied().filter(|&command| applies(command)) {
            self.timeline.command(command, self.editor.project_mut(), now_secs);
        }
        self.record_changes(ui, &before, now_secs, held);
        if !commands.is_empty() {
            // The panels are drawn before the commands run, so the result needs another frame.
            ui.ctx().request_repaint();
        }
        for command in commands {
            self.dispatch(ui, command, wide, &mut actions);
            match command {
                Command::ShowBefore if self.editor.can_undo() => {
                    self.before_until_secs = now_secs + BEFORE_SECS;
                }
                Command::ShowBefore => self.show_notice(NO_EARLIER_VIEW, now_secs),
                _ => {}
            }
        }
        self.show_state(other_state);
        if let Some(scene) = self.surprises.advance(ui) {
            self.fly_into_scene(scene);
        }
        self.timeline.end_frame(&mut self.editor, &before, now_secs);
        self.compare.note(self.editor.project());
        self.moving |= self.timeline.is_moving();
        if self.timeline.is_playing() {
            ui.ctx().request_repaint();
        }
        let is_busy = self.timeline.is_playing()
            || self.pilot.is_moving(now_secs)
            || self.mutate.is_open()
            || self.finder.is_open();
        if self.look_preview.update(self.editor.scene(), is_busy) {
            // The view's caption names the look.
            ui.ctx().request_repaint();
        }
        self.was_typing = ui.ctx().text_edit_focused();
        actions
    }

    fn panels(
        &mut self,
        ui: &mut Ui,
        inputs: &DisplayInputs<'_>,
        wide: bool,
        commands: &mut Vec<Command>,
        actions: &mut Vec<Action>,
    ) {
        let open = self.settings.panel_open;
        let timeline_open = self.settings.timeline_open && (wide || !open);
        self.histogram_shown = false;
        let window = ui.available_size();
        let (can_undo, can_redo) = (self.editor.can_undo(), self.editor.can_redo());
        let project = self.editor.project_mut();
        let mut cx = Context {
            scene: &mut project.scene,
            settings: &mut self.settings,
            selection: &mut self.selection,
            favourites: &mut self.favourites,
            rects: &mut self.rects,
            look_preview: &mut self.look_preview,
            histogram_shown: &mut self.histogram_shown,
            commands,
            actions,
            inputs,
            environment_map: self.loaded.any_environment_map(),
            gradients: &self.loaded.gradients,
            camera_status: self.camera_status,
            view_px: self.view_px,
            is_sheet: !wide,
            flying: self.pilot.is_flying(),
            can_undo,
            can_redo,
        };
        let frame = egui::Frame::new().fill(theme::PANEL);
        let shown = if !wide {
            let size = self.sheet.height(cx.settings, window.y);
            let sheet = Panel::bottom("sheet").exact_size(size).frame(frame);
            Some(sheet.show(ui, |ui| panel::sheet(ui, &mut cx, &mut self.sheet, window.y)))
        } else if open {
            let side =
                Panel::right("panel").resizable(false).exact_size(theme::panel_width(window.x));
            Some(side.frame(frame).show(ui, |ui| panel::side(ui, &mut cx)))
        } else {
            None
        };
        if let Some(shown) = shown {
            cx.rects.record("panel", &shown.response);
            widgets::set_panel_area(ui, shown.response.rect);
            widgets::note_part(ui, PanelPart::Panel.title(), shown.response.rect);
        }
        if timeline_open {
            let margin = Margin { left: 12, right: 8, top: 6, bottom: 8 };
            let strip =
                Panel::bottom("timeline").resizable(false).frame(frame.inner_margin(margin));
            let shown = strip.show(ui, |ui| {
                panel::strip(ui, &mut cx, &mut project.path, &mut self.timeline);
            });
            cx.rects.record("timeline", &shown.response);
            // The buttons of a low window scroll sideways out of the strip.
            let row = shown.response.rect.with_max_x(f32::INFINITY).with_min_x(f32::NEG_INFINITY);
            widgets::note_part(ui, PanelPart::Timeline.title(), row);
        }
        panel::formula_window(ui, &mut cx);
    }

    /// Shows a notice for [`NOTICE_SECS`].
    fn show_notice(&mut self, text: &str, now_secs: f64) {
        let notice = Notice { text: text.to_owned(), ..Notice::default() };
        self.toast.show(notice, now_secs + NOTICE_SECS);
    }

    /// Shows the shell's message, else the interface's own.
    fn notices(
        &mut self,
        ui: &Ui,
        inputs: &DisplayInputs<'_>,
        now_secs: f64,
        actions: &mut Vec<Action>,
    ) {
        self.toast.expire(now_secs);
        if let Some(left_secs) = self.toast.remaining_secs(now_secs) {
            ui.ctx().request_repaint_after_secs(left_secs as f32);
        }
        let own = self.toast.notice().filter(|_| inputs.notice.is_none()).cloned();
        let notice = inputs.notice.or(own.as_ref());
        let shown = DisplayInputs { notice, ..*inputs };
        let first = actions.len();
        notice::show(ui, &shown, self.rects.get("view"), actions, &mut self.rects);
        let is_dismissal = |action: &Action| *action == Action::DismissNotice;
        if own.is_some() && actions[first..].iter().any(is_dismissal) {
            self.toast.take();
            actions.retain(|action| !is_dismissal(action));
        }
    }

    fn status(&mut self, ui: &mut Ui, inputs: &DisplayInputs<'_>) {
        let frame = egui::Frame::new().fill(theme::PANEL);
        let status = status::StatusInputs {
            report: inputs.report,
            scene: self.editor.scene(),
            adapter: inputs.adapter,
            camera_status: self.camera_status,
            flight: self.pilot.is_flying().then(|| self.pilot.speed()),
        };
        let shown = Panel::bottom("status")
            .exact_size(status::HEIGHT)
            .frame(frame)
            .show_separator_line(false)
            .show(ui, |ui| {
                status::status_line(ui, &status);
            });
        self.rects.record("status", &shown.response);
    }

    /// Records the frame's changes, and updates [`Self::is_moving`].
    fn record_changes(&mut self, ui: &Ui, before: &Project, now_secs: f64, held: bool) {
        let changed = before != self.project();
        if changed && ui.input(shortcuts::step_a_value) {
            self.pilot.extend_step(ui.ctx());
        }
        let still_down = ui.input(|i| i.pointer.any_down() || i.any_touches());
        let gesture = (held && still_down) || self.pilot.is_moving(now_secs);
        self.editor.record_changes(before, gesture, now_secs);
        self.moving = gesture && self.editor.secs_since_change(now_secs) < STILL_SECS;
        if self.moving {
            ui.ctx().request_repaint_after_secs(STILL_SECS as f32);
        }
    }
}
