//! An interface on a stage: a harness around it, and shorthands for what tests do with it.

use egui::{
    Event, Modifiers, MouseWheelUnit, PointerButton, Pos2, Rect, Shape, TouchDeviceId, TouchId,
    TouchPhase, Vec2, accesskit::Role, epaint::TextShape,
};
use egui_kittest::{Harness, HarnessBuilder, Node, kittest::Queryable as _};
use mandelight::{
    render::report::{Activity, Report},
    scene::{Project, Scene},
    ui::{
        Action, DisplayInputs, ExportProgress, GalleryState, Interface, KeptPicture,
        MissingEncoders, Notice, Settings, Sharing, SmallTextures, ViewTexture, all_sections_open,
        theme,
    },
};

/// What the harness carries from frame to frame.
pub struct Stage {
    pub interface: Interface,
    pub actions: Vec<Action>,
    pub report: Report,
    pub picture: Option<ViewTexture>,
    pub kept_picture: Option<KeptPicture>,
    pub export: Option<ExportProgress>,
    pub notice: Option<Notice>,
    pub missing_encoders: MissingEncoders,
    pub reading: Option<String>,
    pub small_pictures: SmallTextures,
    pub reduced_motion: bool,
    pub gallery: Option<GalleryState>,
    pub has_share_sheet: bool,
}

/// The notice where the view before the last change is asked for and nothing has changed.
pub const NO_EARLIER_VIEW: &str = "There is no earlier view.";

/// Settings with everything unfolded.
pub fn unfolded() -> Settings {
    Settings { more_open: true, sections: all_sections_open(), ..Settings::default() }
}

/// An interface to a scene, or one with its path, in a window of `size` points.
pub fn stage(
    project: impl Into<Project>,
    settings: Settings,
    size: [f32; 2],
) -> Harness<'static, Stage> {
    stage_with(Harness::builder(), project, settings, size)
}

/// As [`stage`], with a harness of one's own kind.
pub fn stage_with(
    builder: HarnessBuilder<Stage>,
    project: impl Into<Project>,
    settings: Settings,
    size: [f32; 2],
) -> Harness<'static, Stage> {
    builder
        .with_size(Vec2::from(size))
        .with_step_dt(1.0 / 60.0)
        .with_max_steps(150)
        .with_context_setup(theme::install)
        .build_ui_state(
            |ui, stage: &mut Stage| {
                // The harness insets what it shows; the page doesn't.
                let whole = egui::UiBuilder::new().max_rect(ui.ctx().content_rect());
                ui.scope_builder(whole, |ui| stage.show(ui));
            },
            Stage::new(project, settings, size),
        )
}

impl Stage {
    /// What the harness carries at the beginning.
    pub fn new(project: impl Into<Project>, settings: Settings, size: [f32; 2]) -> Self {
        let report = Report {
            activity: Activity::Refining,
            size_px: [size[0] as u32, size[1] as u32],
            converged_fraction: None,
            clamped_light: None,
            samples_done: 4,
            samples_so_far: 4.5,
            samples_wanted: 16,
            pixels_per_sample: 1,
            elapsed_secs: 1.5,
            anchor_ms: 0.0,
            frame_interval_secs: 0.2,
            frame_ms: 7.0,
            pictures: 9,
            memory: Default::default(),
            histogram: None,
        };
        Self {
            interface: Interface::new(project, settings),
            actions: Vec::new(),
            report,
            picture: None,
            kept_picture: None,
            export: None,
            notice: None,
            missing_encoders: MissingEncoders::None,
            reading: None,
            small_pictures: SmallTextures::default(),
            reduced_motion: false,
            gallery: None,
            has_share_sheet: false,
        }
    }

    /// One frame of the interface over all of `ui`.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        let inputs = DisplayInputs {
            picture: self.picture,
            kept_picture: self.kept_picture,
            report: &self.report,
            export: self.export,
            notice: self.notice.as_ref(),
            missing_encoders: self.missing_encoders,
            reading: self.reading.as_deref(),
            adapter: "a test",
            sharing: Sharing {
                address: "https://example.org/",
                has_share_sheet: self.has_share_sheet,
            },
            gallery: self.gallery.as_ref(),
            reduced_motion: self.reduced_motion,
            small_pictures: &self.small_pictures,
        };
        self.actions.extend(self.interface.show(ui, &inputs));
    }
}

/// A new scene on a wide stage, everything unfolded.
pub fn workshop() -> Harness<'static, Stage> {
    stage(Scene::default(), unfolded(), [1280.0, 6000.0])
}

/// Lets flights of this stage arrive at once.
pub fn without_motion(mut harness: Harness<'static, Stage>) -> Harness<'static, Stage> {
    harness.state_mut().reduced_motion = true;
    harness.run();
    harness
}

pub fn scene<'h>(harness: &'h Harness<'_, Stage>) -> &'h Scene {
    harness.state().interface.scene()
}

pub fn slider<'h>(harness: &'h Harness<'_, Stage>, label: &'h str) -> Node<'h> {
    harness.get_by_role_and_label(Role::Slider, label)
}

pub fn button<'h>(harness: &'h Harness<'_, Stage>, label: &'h str) -> Node<'h> {
    harness.get_by_role_and_label(Role::Button, label)
}

pub fn press(harness: &mut Harness<'_, Stage>, label: &str) {
    button(harness, label).click();
    harness.run();
}

pub fn pointer(
    harness: &Harness<'_, Stage>,
    at: Pos2,
    button: PointerButton,
    pressed: bool,
    modifiers: Modifiers,
) {
    harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
}

/// A drag with the primary button from one place to another, in `steps` moves.
pub fn drag(harness: &mut Harness<'_, Stage>, from: Pos2, to: Pos2, steps: u32) {
    harness.event(Event::PointerMoved(from));
    harness.step();
    pointer(harness, from, PointerButton::Primary, true, Modifiers::NONE);
    harness.step();
    for i in 1..=steps {
        harness.event(Event::PointerMoved(from + (to - from) * (i as f32 / steps as f32)));
        harness.step();
    }
    pointer(harness, to, PointerButton::Primary, false, Modifiers::NONE);
    harness.run();
}

fn flatten<'a>(shape: &'a Shape, into: &mut Vec<&'a Shape>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| flatten(shape, into)),
        shape => into.push(shape),
    }
}

/// A turn of the wheel by `points`, up if positive.
pub fn wheel(points: f32) -> Event {
    Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: egui::vec2(0.0, points),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    }
}

/// Presses a tool over the picture, also where it is in the menu of further tools.
pub fn press_tool(harness: &mut Harness<'_, Stage>, name: &str) {
    if harness.query_by_label(name).is_none() {
        press(harness, "More tools");
    }
    press(harness, name);
}

/// Touches the middle of the window: from now on, the screen is known to be used with fingers.
pub fn touch(harness: &mut Harness<'_, Stage>) {
    let pos = harness.ctx.content_rect().center();
    for phase in [TouchPhase::Start, TouchPhase::End] {
        let (device_id, id) = (TouchDeviceId(0), TouchId(0));
        harness.event(Event::Touch { device_id, id, phase, pos, force: None });
        harness.step();
    }
    harness.run();
}

/// What the last frame painted, the lowest first.
pub fn shapes<'h>(harness: &'h Harness<'_, Stage>) -> Vec<&'h Shape> {
    let mut shapes = Vec::new();
    harness.output().shapes.iter().for_each(|clipped| flatten(&clipped.shape, &mut shapes));
    shapes
}

/// The texts that the last frame painted.
pub fn painted_texts<'h>(harness: &'h Harness<'_, Stage>) -> impl Iterator<Item = &'h TextShape> {
    shapes(harness).into_iter().filter_map(|shape| match shape {
        Shape::Text(text) => Some(text),
        _ => None,
    })
}

/// Where the last frame painted this text.
pub fn painted(harness: &Harness<'_, Stage>, words: &str) -> Vec<Rect> {
    let texts = painted_texts(harness).filter(|text| text.galley.text() == words);
    texts.map(TextShape::visual_bounding_rect).collect()
}

/// Steps back in the history until there is none, and counts them.
pub fn undo_all(harness: &mut Harness<'_, Stage>) -> usize {
    let mut count = 0;
    while harness.state_mut().interface.editor_mut().can_undo() {
        harness.key_press_modifiers(Modifiers::COMMAND, egui::Key::Z);
        harness.run();
        count += 1;
        assert!(count < 1000, "undo has no end");
    }
    count
}
