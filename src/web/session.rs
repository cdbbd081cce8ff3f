//! The visit's state, which outlives a lost GPU: the interface with its scene, the notice, the files.
//!
//! In: the address and the storage at start-up; messages later. Out: the scene to draw, saved to the
//! storage and the address.

use std::{cell::RefCell, io::Cursor, rc::Rc, sync::Arc};

use super::{
    address::Address,
    autosave::{self, Autosave},
    device_loss,
    files::{self, FilePicker},
    gallery,
    mailbox::{Mailbox, Message},
    page, storage,
};
use crate::{
    export,
    gpu::Gpu,
    reading::visible_lines,
    render::Report,
    scene::{BackgroundKind, Project, Scene, document, environment_map, gradient, link, presets},
    ui::{
        Favourites, GalleryState, Interface, Notice, Settings,
        loss_policy::{SafeMode, Start},
        theme,
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
    /// The file dialogue.
    pub picker: FilePicker,
    /// The device; `None` after a loss, until the restart.
    pub gpu: Option<Gpu>,
    /// The gallery that the address names, if it names one.
    pub gallery: Option<GalleryState>,
    /// The notice to the visitor, until it is dismissed or expires.
    pub notice: Option<Notice>,
    /// When the notice expires, on the page's clock.
    notice_until_secs: f64,
    /// The app's status after the last step.
    pub status: AppStatus,
    safe_mode: SafeMode,
    /// The scene in which drawing is paused.
    paused_scene: Option<Scene>,
    /// The project that lost the GPU several times, so that the visit began with another one.
    offered: Option<Project>,
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
    /// The finished part of the export in progress, 0 to 1; none without one.
    pub exported: Option<f32>,
}

impl Session {
    /// Opens the scene of the address, of the last visit, or the first opening scene.
    pub fn open() -> Self {
        let address = Address::default();
        let (project, error) = initial_project(&address);
        let has_link = project.is_some() && address.read_foreign().is_some();
        let settings = stored_settings().unwrap_or_else(|| first_settings(has_link));
        let opening = Project::from(presets::opening());
        let named = project.unwrap_or_else(|| opening.clone());
        let start = device_loss::start(&named.scene);
        let (project, offered) = match start {
            Start::Offer if named != opening => (opening, Some(named)),
            _ => (named, None),
        };
        let safe_mode = match (start, &offered) {
            (Start::Open(safe_mode), _) => safe_mode,
            // The offer has a notice of its own.
            (Start::Offer, Some(_)) => SafeMode::Off,
            (Start::Offer, None) => SafeMode::Paused,
        };
        let mut interface = Interface::new(project, settings);
        if offered.is_none() {
            interface.editor_mut().restore_steps(autosave::stored_steps());
        }
        *interface.favourites_mut() = stored_favourites();
        let mailbox = Mailbox::default();
        address.watch(&mailbox);
        let mut session = Self {
            autosave: Autosave::new(address),
            picker: FilePicker::new(&mailbox),
            interface,
            gallery: gallery::open(&mailbox),
            mailbox,
            gpu: None,
            notice: None,
            notice_until_secs: 0.0,
            status: AppStatus::default(),
            safe_mode: SafeMode::Off,
            paused_scene: None,
            offered,
        };
        session.enter_safe_mode(safe_mode);
        session.report_missing_environment_map();
        session.show_offer();
        if let Some(error) = error {
            session.show_error(error);
        }
        session
    }

    /// Saves the session whenever the visitor may be about to leave the page.
    pub fn save_on_leave(session: &Rc<RefCell<Self>>) {
        let save = || {
            let session = session.clone();
            // Within a frame the session is borrowed; autosave then writes after the frame.
            move || {
                if let Ok(mut session) = session.try_borrow_mut() {
                    session.save();
                }
            }
        };
        if let Some(window) = page::window() {
            page::listen(&window, "pagehide", save());
        }
        if let Some(document) = page::document() {
            page::listen(&document, "visibilitychange", save());
        }
    }

    /// Shows the notice that offers the scene which lost the GPU, if there is one.
    fn show_offer(&mut self) {
        if self.offered.is_some() {
            let text = "The graphics card stopped several times while it drew your last scene, so another one was opened.";
            let offer = Some("Open it anyway");
            self.show(Notice { text: text.into(), is_error: true, offer }, f64::INFINITY);
        }
    }

    /// Opens the offered scene, with a smaller picture until one is complete.
    pub fn take_offer(&mut self) {
        self.notice = None;
        if let Some(project) = self.offered.take() {
            self.interface.replace_project(project);
            self.enter_safe_mode(SafeMode::Reduced);
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
        if self.safe_mode == SafeMode::Reduced {
            self.safe_mode = SafeMode::Off;
            // The picture is of another scene than the offered one.
            if self.offered.is_none() {
                device_loss::note_complete_picture();
            }
            self.mailbox.wake();
        }
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

    fn show(&mut self, notice: Notice, secs: f64) {
        // A notice may quote files and names.
        let text = visible_lines(&notice.text).into_owned();
        self.notice = Some(Notice { text, ..notice });
        self.notice_until_secs = page::now_secs() + secs;
    }

    /// Removes an expired notice. Returns the seconds until the notice expires.
    pub fn expire_notice(&mut self, now_secs: f64) -> Option<f64> {
        self.notice.as_ref()?;
        let left_secs = self.notice_until_secs - now_secs;
        if left_secs > 0.0 {
            return left_secs.is_finite().then_some(left_secs);
        }
        self.notice = None;
        None
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
                Message::File { name, content } => {
                    let opened = content.and_then(|bytes| self.open_file(&name, &bytes));
                    opened.unwrap_or_else(|reason| {
                        self.show_error(format!("{name} could not be opened: {reason}"));
                    });
                }
                Message::Fragment(fragment) => match link::project_from_fragment(&fragment) {
                    Ok(project) => {
                        self.interface.replace_project(project);
                        self.report_missing_environment_map();
                    }
                    Err(error) => self.show_error(error.to_string()),
                },
                Message::Favourite { document, jpeg } => {
                    self.interface.keep_favourite(document, jpeg);
                }
                Message::Gallery(state) => self.gallery = Some(state),
                Message::GalleryPicture { name, content } => {
                    match content.and_then(|bytes| read_project(&bytes)) {
                        Ok(project) => {
                            self.interface.fly_into(project);
                            self.report_missing_environment_map();
                        }
                        Err(reason) => {
                            self.show_error(format!("{name} could not be opened: {reason}"));
                        }
                    }
                }
                Message::Notice(text) => self.show_notice(text),
                Message::Error(text) => self.show_error(text),
            }
        }
    }

    /// Opens a scene, a picture that contains one, an environment map, or gradients.
    fn open_file(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        // An OpenEXR picture saved by Mandelight is also a valid environment map: its scene wins.
        if environment_map::is_environment_map(bytes) && exr_scene(bytes).is_none() {
            let environment_map =
                environment_map::decode(name, bytes).map_err(|error| error.to_string())?;
            self.interface.use_environment_map(Arc::new(environment_map));
            let lights = self.interface.scene().lights.rig.len();
            self.show_notice(format!(
                "{name} now lights the scene: {lights} lights in addition to those of the list."
            ));
            return Ok(());
        }
        if let Some((stem, ending)) = name.rsplit_once('.')
            && gradient::ENDINGS.contains(&ending.to_ascii_lowercase().as_str())
        {
            let found = gradient::read(bytes, stem).map_err(|error| error.to_string())?;
            let count = found.len();
            self.interface.use_gradients(found);
            self.show_notice(match count {
                1 => format!("{name} now colours the surface."),
                _ => format!("The first of {count} gradients in {name} now colours the surface. Choose another under Colours."),
            });
            return Ok(());
        }
        self.interface.replace_project(read_project(bytes)?);
        self.show_notice(format!("Opened {name}."));
        self.report_missing_environment_map();
        Ok(())
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
    pub fn note_loss(&mut self) -> Option<SafeMode> {
        self.gpu = None;
        self.status = AppStatus { frames: self.status.frames, ..AppStatus::default() };
        // The next visit finds the scene that lost the GPU, and knows it by its text.
        self.autosave.write(self.interface.editor());
        self.save();
        device_loss::note_loss(self.interface.scene())
    }

    /// Writes the kept views, if they changed.
    pub fn save_favourites(&mut self) {
        let favourites = self.interface.favourites_mut();
        if favourites.take_changed() && !storage::FAVOURITES.try_write(&favourites.to_json()) {
            self.show_error(
                "The browser could not store the view: its storage is full or blocked. Save the scene as a file instead.",
            );
        }
    }

    /// Writes the project and the interface's settings now.
    pub fn save(&mut self) {
        self.autosave.flush(self.interface.editor());
        match serde_json::to_string(self.interface.settings()) {
            Ok(text) => storage::SETTINGS.write(&text),
            Err(error) => log::warn!("cannot store the settings: {error}"),
        }
    }
}

/// The project of the address or of the last visit, and any error.
fn initial_project(address: &Address) -> (Option<Project>, Option<String>) {
    let mut link_error = None;
    if let Some(fragment) = address.read_foreign() {
        match link::project_from_fragment(&fragment) {
            Ok(project) => return (Some(project), None),
            Err(error) => link_error = Some(error.to_string()),
        }
    }
    let stored = storage::SCENE.read().and_then(|text| {
        document::project_from_json(&text)
            .inspect_err(|error| log::warn!("cannot read the scene of the last visit: {error}"))
            .ok()
    });
    (stored, link_error)
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

/// The views that were kept at earlier visits.
fn stored_favourites() -> Favourites {
    let text = storage::FAVOURITES.read().unwrap_or_default();
    if text.is_empty() {
        return Favourites::default();
    }
    Favourites::from_json(&text).unwrap_or_else(|error| {
        log::warn!("cannot read the kept views: {error}");
        Favourites::default()
    })
}

/// The settings of the last visit.
fn stored_settings() -> Option<Settings> {
    let text = storage::SETTINGS.read();
    text.and_then(|text| {
        serde_json::from_str(&text)
            .inspect_err(|error| log::warn!("cannot read the settings of the last visit: {error}"))
            .ok()
    })
}

/// The project in a file: a document, or a picture that contains one.
fn read_project(bytes: &[u8]) -> Result<Project, String> {
    let text = match export::picture_scene_text(bytes) {
        Some(text) => {
            text?.ok_or("the picture contains no scene; only pictures saved by Mandelight do")?
        }
        None => String::from_utf8(bytes.to_vec()).map_err(|_| {
            "the file is neither a scene nor a picture that Mandelight can read".to_owned()
        })?,
    };
    document::project_from_json(&text).map_err(|error| error.to_string())
}

/// The document in an OpenEXR file.
fn exr_scene(bytes: &[u8]) -> Option<String> {
    export::is_exr(bytes).then(|| export::exr_scene_text(Cursor::new(bytes)).ok()?)?
}
