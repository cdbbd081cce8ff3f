//! The visit's state, which outlives a lost GPU: the interface with its scene, the notice, the files.
//!
//! In: the address and the storage at start-up; messages later. Out: the scene to draw, saved to the
//! storage and the address.

use std::{cell::RefCell, rc::Rc, sync::Arc};

use super::{
    address::Address,
    autosave::{self, Autosave},
    decoder::Decoder,
    device_loss,
    file_content::FileContent,
    files::{self, FilePicker},
    gallery,
    mailbox::{Mailbox, Message},
    page, scene_watch, stored,
};
use crate::{
    gpu::Gpu,
    reading::visible_lines,
    render::Report,
    scene::{BackgroundKind, Project, Scene, link, presets},
    ui::{
        GalleryState, Interface, Notice, Settings,
        file_progress::{FileInProgress, SceneUse},
        loss_policy::{SafeMode, Start},
        theme,
        toast::Toast,
    },
};

/// Seconds that a notice of a success stays.
const SUCCESS_SECS: f64 = 6.0;
/// Seconds that a notice of a failure stays: it has to be read, and acted on.
const FAILURE_SECS: f64 = 20.0;

/// The state of a visit.
pub struct Session {
    /// The panels, the scene in view and its history.
    pub interface: Interface,
    /// The messages from callbacks.
    pub mailbox: Mailbox,
    /// Writes the scene to the storage and the address.
    pub autosave: Autosave,
    /// Decodes files, in a worker.
    pub decoder: Decoder,
    /// The file dialogue.
    pub picker: FilePicker,
    /// The device; `None` after a loss, until the restart.
    pub gpu: Option<Gpu>,
    /// The gallery that the address names, if it names one.
    pub gallery: Option<GalleryState>,
    /// The notice to the visitor, until it is dismissed or expires on the page's clock.
    pub toast: Toast,
    /// The app's status after the last step.
    pub status: AppStatus,
    /// The kept formulas as they were last read or stored.
    known_formulas: Vec<String>,
    /// Whether the visitor knows that the storage keeps nothing.
    has_shown_storage_notice: bool,
    safe_mode: SafeMode,
    /// The scene in which drawing is paused.
    paused_scene: Option<Scene>,
    /// The project that ended or hindered earlier visits, so that this one began with another.
    offered: Option<Offered>,
    /// Time of this visit's last loss of the GPU, in seconds since 1970.
    lost_at_secs: Option<f64>,
    /// Whether the scene in view is the one that lost the GPU.
    has_lost_scene: bool,
    /// Whether a picture of this visit has been complete.
    has_completed: bool,
}

/// A project that is offered instead of opened.
struct Offered {
    project: Project,
    /// Whether a visit ended with it; otherwise it lost the GPU several times.
    has_ended: bool,
    /// How it would begin by its losses of the GPU.
    start: Start,
}

/// The app's status, for the interface and the tests.
#[derive(Default)]
pub struct AppStatus {
    /// The view's report.
    pub report: Report,
    /// The newest picture on the GPU.
    pub texture: Option<wgpu::Texture>,
    /// The view's compute dispatches so far.
    pub dispatches: u64,
    /// The interface's frames so far.
    pub frames: u64,
    /// The small pictures on the GPU.
    pub small_pictures: usize,
    /// Whether small pictures are missing.
    pub has_small_pictures_left: bool,
    /// egui's own textures.
    pub ui_textures: usize,
    /// The finished part of the export in progress, 0 to 1; none without one.
    pub exported: Option<f32>,
}

impl Session {
    /// Opens the scene of the address, of the last visit, or the first opening scene.
    pub fn open() -> Self {
        let address = Address::default();
        let opened = autosave::stored_scene();
        let settings = stored::settings().unwrap_or_else(|| first_settings(opened.is_link));
        let known_formulas = settings.formulas.clone();
        let opening = Project::from(presets::opening());
        let named = opened.project.unwrap_or_else(|| opening.clone());
        let start = device_loss::start(&named.scene);
        let has_ended = scene_watch::has_ended_with(&named.scene);
        let is_offered = named != opening && (has_ended || start == Start::Offer);
        let (project, offered) = match is_offered {
            true => (opening, Some(Offered { project: named, has_ended, start })),
            false => (named, None),
        };
        scene_watch::watch(&project.scene);
        let safe_mode = match (&offered, start) {
            // The offer has a notice of its own.
            (Some(_), _) => SafeMode::Off,
            (None, Start::Open(safe_mode)) => safe_mode,
            (None, Start::Offer) => SafeMode::Paused,
        };
        let mut interface = Interface::new(project, settings);
        // The offered project is the last step, so that nothing is lost if the offer is not taken.
        let mut steps = autosave::stored_steps();
        steps.extend(offered.iter().map(|offered| offered.project.clone()));
        interface.editor_mut().restore_steps(steps);
        let (favourites, list_problem) = stored::favourites();
        *interface.favourites_mut() = favourites;
        let mailbox = Mailbox::default();
        address.watch(&mailbox);
        watch_storage(&mailbox);
        let mut session = Self {
            autosave: Autosave::new(address),
            decoder: Decoder::default(),
            picker: FilePicker::new(&mailbox),
            interface,
            gallery: gallery::open(&mailbox),
            mailbox,
            gpu: None,
            toast: Toast::default(),
            status: AppStatus::default(),
            known_formulas,
            has_shown_storage_notice: false,
            safe_mode: SafeMode::Off,
            paused_scene: None,
            has_lost_scene: offered.is_none() && safe_mode == SafeMode::Paused,
            offered,
            lost_at_secs: None,
            has_completed: false,
        };
        session.report_missing_environment_map();
        session.enter_safe_mode(safe_mode);
        session.show_offer();
        let problems: Vec<String> = opened.problem.into_iter().chain(list_problem).collect();
        if !problems.is_empty() {
            let pause = safe_mode.explain().map(str::to_owned);
            let texts: Vec<String> = problems.into_iter().chain(pause).collect();
            session.show_error(texts.join("\n"));
        }
        session
    }

    /// Saves the session whenever the visitor may be about to leave the page.
    pub fn save_on_leave(session: &Rc<RefCell<Self>>) {
        let save_and = |watch: fn()| {
            let session = session.clone();
            // Within a frame the session is borrowed, and after a panic for good; autosave writes after a frame.
            move || {
                if let Ok(mut session) = session.try_borrow_mut() {
                    session.save();
                    watch();
                }
            }
        };
        if let Some(window) = page::window() {
            page::listen(&window, "pagehide", save_and(scene_watch::leave));
            page::listen(&window, "pageshow", save_and(scene_watch::come_back));
        }
        if let Some(document) = page::document() {
            let watch = || match page::is_hidden() {
                true => scene_watch::leave(),
                false => scene_watch::come_back(),
            };
            page::listen(&document, "visibilitychange", save_and(watch));
        }
    }

    /// Shows the notice that offers the scene which ended or hindered earlier visits, if there is one.
    fn show_offer(&mut self) {
        if let Some(offered) = &self.offered {
            let text = match offered.has_ended {
                true => {
                    "The page stopped while this visit's scene was in view, so the opening scene is shown instead."
                }
                false => {
                    "The graphics card stopped several times while drawing this visit's scene, so the opening scene is shown instead."
                }
            };
            let offer = Some("Open the scene anyway");
            self.show(Notice { text: text.into(), is_error: true, offer }, f64::INFINITY);
        }
    }

    /// Opens the offered scene; one that lost the GPU with a smaller picture until one is complete.
    pub fn take_offer(&mut self) {
        self.toast.take();
        if let Some(Offered { project, start, .. }) = self.offered.take() {
            scene_watch::watch(&project.scene);
            self.interface.replace_project(project);
            if start != Start::Open(SafeMode::Off) {
                self.has_lost_scene = start != Start::Open(SafeMode::Reduced);
                self.enter_safe_mode(SafeMode::Reduced);
            }
            self.report_missing_environment_map();
        }
    }

    /// Sets the safe mode and shows its notice.
    pub fn enter_safe_mode(&mut self, safe_mode: SafeMode) {
        self.safe_mode = safe_mode;
        self.paused_scene = (safe_mode == SafeMode::Paused).then(|| self.interface.scene().clone());
        if let Some(text) = safe_mode.explain() {
            self.show_error(text);
        }
    }

    /// Ends a pause if the scene has changed, and returns the safe mode.
    pub fn update_safe_mode(&mut self) -> SafeMode {
        if self.safe_mode == SafeMode::Paused
            && self.paused_scene.as_ref() != Some(self.interface.scene())
        {
            self.safe_mode = SafeMode::Reduced;
            self.paused_scene = None;
        }
        self.safe_mode
    }

    /// Ends the reduced mode: the GPU has completed a picture.
    pub fn note_complete_picture(&mut self) {
        let is_first = !std::mem::replace(&mut self.has_completed, true);
        // After an offer, another scene than the lost one is in view.
        if self.has_lost_scene {
            self.has_lost_scene = false;
            device_loss::note_complete_picture();
        } else if is_first && self.offered.is_none() {
            device_loss::note_other_picture();
        }
        if self.safe_mode == SafeMode::Reduced {
            self.safe_mode = SafeMode::Off;
            self.mailbox.wake();
        }
    }

    /// What the safe mode says of drawing that is paused.
    pub fn pause_text(&self) -> Option<&'static str> {
        self.safe_mode.explain().filter(|_| self.safe_mode == SafeMode::Paused)
    }

    /// Removes the notice; an offer that it made is declined, and one that it covered is shown.
    pub fn dismiss_notice(&mut self) {
        if self.toast.take().is_some_and(|notice| notice.offer.is_some()) {
            self.offered = None;
        }
        self.show_offer();
    }

    /// Shows a success to the visitor, for some seconds.
    pub fn show_notice(&mut self, text: impl Into<String>) {
        self.show(Notice { text: text.into(), ..Notice::default() }, SUCCESS_SECS);
    }

    /// Shows a failure to the visitor, for longer.
    pub fn show_error(&mut self, text: impl Into<String>) {
        let notice = Notice { text: text.into(), is_error: true, ..Notice::default() };
        self.show(notice, FAILURE_SECS);
    }

    fn show_unopened(&mut self, name: &str, reason: &str) {
        self.show_error(format!("{name} could not be opened: {reason}"));
    }

    fn show(&mut self, notice: Notice, secs: f64) {
        // A notice may quote files and names.
        let text = visible_lines(&notice.text).into_owned();
        self.toast.show(Notice { text, ..notice }, page::now_secs() + secs);
    }

    /// Removes an expired notice. Returns the seconds until the notice expires.
    pub fn expire_notice(&mut self, now_secs: f64) -> Option<f64> {
        if self.toast.expire(now_secs) {
            self.show_offer();
        }
        self.toast.remaining_secs(now_secs)
    }

    /// Copies a link to this view, and to its camera path where that fits.
    pub fn copy_link(&mut self) {
        let project = self.interface.project();
        let (fragment, notice) = match link::project_to_fragment(project) {
            Ok(fragment) => (Ok(fragment), "Link copied. Paste it anywhere to share this view."),
            Err(_) => (
                link::to_fragment(&project.scene),
                "Link copied, without the camera path, which is too long for a link. To share the path, save the scene as a file.",
            ),
        };
        match fragment {
            Ok(fragment) => match Address::with_fragment(&fragment) {
                Some(address) => files::copy_link(address, notice, &self.mailbox),
                None => self.show_error(
                    "This page has no address to share. Save the scene as a file instead.",
                ),
            },
            Err(error) => self.show_error(error.to_string()),
        }
    }

    /// Handles the messages since the last frame.
    pub fn read_messages(&mut self) {
        for message in self.mailbox.take() {
            match message {
                Message::File(file) => {
                    let name = file.name();
                    self.decoder.start(name, file.into(), SceneUse::Open, &self.mailbox);
                }
                Message::Decoded { ticket, content } => {
                    // A newer file, or a cancellation, leaves the result of an older one unused.
                    let Some(reading) = self.decoder.finish(ticket) else { continue };
                    match content {
                        Ok(content) => self.use_content(&reading, content),
                        Err(reason) => self.show_unopened(&reading.name, &reason),
                    }
                }
                Message::Fragment(fragment) => match link::project_from_fragment(&fragment) {
                    Ok(project) => {
                        // The address names it already, before autosave writes it.
                        scene_watch::watch(&project.scene);
                        self.interface.replace_project(project);
                        self.report_missing_environment_map();
                    }
                    Err(error) => self.show_error(error.to_string()),
                },
                Message::Favourite { document, jpeg } => {
                    self.interface.keep_favourite(document, jpeg);
                }
                Message::Storage => {
                    // If the list cannot be read, the next view that is kept shows a notice.
                    stored::merge_stored_favourites(self.interface.favourites_mut());
                }
                Message::Gallery(state) => self.gallery = Some(state),
                Message::GalleryPicture { ticket, name, content } => match content {
                    Ok(file) => self.decoder.decode(ticket, name, file, &self.mailbox),
                    Err(reason) => {
                        let Some(reading) = self.decoder.finish(ticket) else { continue };
                        self.show_unopened(&reading.name, &reason);
                    }
                },
                Message::Notice(text) => self.show_notice(text),
                Message::Error(text) => self.show_error(text),
            }
        }
    }

    /// Uses what a file holds.
    fn use_content(
        &mut self,
        FileInProgress { name, purpose, .. }: &FileInProgress,
        content: FileContent,
    ) {
        match content {
            FileContent::Project(project) if *purpose == SceneUse::FlyInto => {
                self.interface.fly_into(*project);
                self.report_missing_environment_map();
            }
            FileContent::Project(project) => {
                self.interface.replace_project(*project);
                self.show_notice(format!("Opened {name}."));
                self.report_missing_environment_map();
            }
            FileContent::EnvironmentMap(environment_map) => {
                self.interface.use_environment_map(Arc::new(environment_map));
                let lights = self.interface.scene().lights.rig.len();
                self.show_notice(format!(
                    "{name} now lights the scene: {lights} lights in addition to those of the list."
                ));
            }
            FileContent::Gradients(found) => {
                let count = found.len();
                self.interface.use_gradients(found);
                self.show_notice(match count {
                    1 => format!("{name} now colours the surface."),
                    _ => format!("The first of {count} gradients in {name} now colours the surface. Choose another under Colours."),
                });
            }
        }
    }

    /// Shows a notice where the background's environment map is not loaded.
    fn report_missing_environment_map(&mut self) {
        let scene = self.interface.scene();
        let name = scene.lights.rig.environment_map.name.clone();
        let is_background = scene.background.kind == BackgroundKind::EnvironmentMap;
        if is_background && !name.is_empty() && self.interface.environment_map().is_none() {
            self.show_notice(format!(
                "The scene has its light from {name}, but the background needs the file itself. Drop {name} on the page to see it."
            ));
        }
    }

    /// Drops what belongs to the lost GPU, saves the rest, and notes the loss.
    ///
    /// Returns the safe mode of the restart; `None` after too many losses to restart.
    pub fn note_loss(&mut self, is_exporting: bool) -> Option<SafeMode> {
        self.gpu = None;
        self.status = AppStatus { frames: self.status.frames, ..AppStatus::default() };
        // The next visit finds the scene that lost the GPU, and knows it by its text.
        if self.offered.is_none() {
            self.autosave.write(self.interface.editor());
        }
        self.save();
        // While an export is drawn, the view rests. An offered scene remains the one that lost the GPU.
        let is_scene_lost = !is_exporting && self.offered.is_none();
        self.has_lost_scene |= is_scene_lost;
        let scene = is_scene_lost.then(|| self.interface.scene());
        device_loss::note_loss(scene, &mut self.lost_at_secs)
    }

    /// Writes the kept views, if they changed.
    pub fn save_favourites(&mut self) {
        let favourites = self.interface.favourites_mut();
        if favourites.take_changed() && !stored::save_favourites(favourites) {
            self.show_error(
                "The browser could not store the view: its storage is full or blocked. Save the scene as a file instead.",
            );
        }
    }

    /// Shows once that the storage refuses the scene.
    pub fn show_storage_notice(&mut self) {
        if self.autosave.take_failure()
            && !std::mem::replace(&mut self.has_shown_storage_notice, true)
        {
            self.show_error(
                "The browser does not store your scene: its storage is full or blocked. The address keeps what fits into a link. Save the scene as a file before you leave.",
            );
        }
    }

    /// Writes the project and the interface's settings now.
    pub fn save(&mut self) {
        self.autosave.flush(self.interface.editor());
        stored::save_settings(self.interface.settings_mut(), &mut self.known_formulas);
    }
}

/// Posts a message whenever another tab has changed the storage.
fn watch_storage(mailbox: &Mailbox) {
    let Some(window) = page::window() else { return };
    let mailbox = mailbox.clone();
    page::listen(&window, "storage", move || mailbox.post(Message::Storage));
}

/// The settings of a first visit. Where the panel is a sheet over the picture, a linked picture has
/// the window for itself.
fn first_settings(has_link: bool) -> Settings {
    let has_sheet = page::size_px().is_some_and(|size| {
        let [width, height] = size.map(|side| side as f32);
        !theme::has_side_panel(egui::vec2(width, height))
    });
    Settings { panel_open: !(has_link && has_sheet), ..Settings::default() }
}
