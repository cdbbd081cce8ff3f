//! What outlives the GPU: the interface with its scene and history, and where both are kept.
//!
//! In: the address and the storage at start-up; messages later on. Out: a scene that is never lost.

use std::{cell::RefCell, io::Cursor, rc::Rc, sync::Arc};

use super::{
    address::Address,
    autosave::Autosave,
    device_loss::{self, Caution},
    files::{self, Picker},
    mailbox::{Mailbox, Message},
    page, storage,
};
use crate::{
    export,
    gpu::Gpu,
    render::{Report, frame::Dispatches},
    scene::{BackgroundKind, Project, Scene, document, environment_map, link},
    ui::{Interface, Notice, Settings, theme},
};

/// How long a notice of something that went well stays, seconds.
const NOTICE_SECS: f64 = 6.0;

/// The page's state.
pub struct Session {
    /// The panels, the scene in view and its history.
    pub interface: Interface,
    /// Where callbacks leave word.
    pub mailbox: Mailbox,
    /// Writes the scene to storage and address.
    pub autosave: Autosave,
    /// The file dialogue.
    pub picker: Picker,
    /// The device, while there is one.
    pub gpu: Option<Gpu>,
    /// What the person at the page is told, until it is read.
    pub notice: Option<Notice>,
    /// When the notice goes by itself, on the page's clock; never where something failed.
    notice_until_secs: Option<f64>,
    /// What the app last said of itself.
    pub status: Status,
    caution: Caution,
    /// The scene that was in view when drawing was paused.
    paused_at: Option<Scene>,
}

/// What the app says of itself once a frame.
#[derive(Default)]
pub struct Status {
    /// What the view is doing.
    pub report: Report,
    /// The newest picture.
    pub texture: Option<wgpu::Texture>,
    /// Compute dispatches of the view so far.
    pub dispatches: Dispatches,
    /// Frames of the interface so far.
    pub frames: u64,
    /// Whether a picture or a sequence is being made.
    pub is_exporting: bool,
}

impl Session {
    /// Opens with the scene of the address, or else the one of the last visit, or else the first
    /// of the opening scenes.
    pub fn open() -> Self {
        let address = Address::default();
        let (project, complaint) = known_project(&address);
        let comes_by_link = project.is_some() && address.read_foreign().is_some();
        let settings = stored_settings().unwrap_or_else(|| first_settings(comes_by_link));
        let interface = Interface::new(project.unwrap_or_default(), settings);
        let mailbox = Mailbox::default();
        address.watch(&mailbox);
        let mut session = Self {
            autosave: Autosave::new(address),
            picker: Picker::new(&mailbox),
            interface,
            mailbox,
            gpu: None,
            notice: None,
            notice_until_secs: None,
            status: Status::default(),
            caution: Caution::None,
            paused_at: None,
        };
        session.be_cautious(device_loss::caution_at_start(session.fragment().as_deref()));
        session.miss_environment_map();
        if let Some(complaint) = complaint {
            session.complain(complaint);
        }
        session
    }

    /// Writes everything down whenever the page is about to be left.
    pub fn watch_page(session: &Rc<RefCell<Self>>) {
        let leave = || {
            let session = session.clone();
            // In the middle of a frame the session is taken; the frame's own end writes then.
            move || {
                if let Ok(mut session) = session.try_borrow_mut() {
                    session.write_down();
                }
            }
        };
        if let Some(window) = page::window() {
            page::listen(&window, "pagehide", leave());
        }
        if let Some(document) = page::document() {
            page::listen(&document, "visibilitychange", leave());
        }
    }

    /// The scene in view as the address holds it; none where it is too large for an address.
    pub fn fragment(&self) -> Option<String> {
        link::to_fragment(self.interface.scene()).ok()
    }

    /// Sets how much is risked with the scene in view, and tells.
    pub fn be_cautious(&mut self, caution: Caution) {
        self.caution = caution;
        self.paused_at = (caution == Caution::Paused).then(|| self.interface.scene().clone());
        if let Some(text) = caution.explain() {
            self.complain(text);
        }
    }

    /// How much is risked with the scene in view. A paused scene stays so until it is changed.
    pub fn caution(&mut self) -> Caution {
        if self.caution == Caution::Paused
            && self.paused_at.as_ref() != Some(self.interface.scene())
        {
            self.caution = Caution::Smaller;
            self.paused_at = None;
        }
        self.caution
    }

    /// Notes that a whole picture was finished with the present caution.
    pub fn note_finished(&mut self) {
        if self.caution == Caution::Smaller {
            self.caution = Caution::None;
            device_loss::note_finished();
            self.mailbox.wake();
        }
    }

    /// Tells the person at the page something.
    pub fn say(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice { text: text.into(), is_error: false });
        self.notice_until_secs = Some(page::now_secs() + NOTICE_SECS);
    }

    /// Tells the person at the page of something that failed.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice { text: text.into(), is_error: true });
        self.notice_until_secs = None;
    }

    /// Takes a notice away once its time is over. Returns the seconds that it has left.
    pub fn expire_notice(&mut self, now_secs: f64) -> Option<f64> {
        let left_secs = self.notice_until_secs? - now_secs;
        if left_secs > 0.0 {
            return Some(left_secs);
        }
        self.notice_until_secs = None;
        self.notice = None;
        None
    }

    /// Puts the address that shares this view on the clipboard.
    pub fn copy_link(&mut self) {
        let project = self.interface.project();
        let (fragment, said) = match link::project_to_fragment(project) {
            Ok(fragment) => (Ok(fragment), "The link is on the clipboard."),
            Err(_) => (
                link::to_fragment(&project.scene),
                "The link is on the clipboard, without the camera path, which is too long for one.",
            ),
        };
        match fragment {
            Ok(fragment) => match Address::with_fragment(&fragment) {
                Some(address) => files::copy_text(address, said, &self.mailbox),
                None => self.complain("This page has no address to share."),
            },
            Err(error) => self.complain(error.to_string()),
        }
    }

    /// Does what the messages since the last frame ask for.
    pub fn read_messages(&mut self) {
        for message in self.mailbox.take() {
            match message {
                Message::File { name, content } => {
                    let opened = content.and_then(|bytes| self.open_file(&name, &bytes));
                    opened.unwrap_or_else(|reason| self.complain(format!("{name}: {reason}")));
                }
                Message::Fragment(fragment) => match link::project_from_fragment(&fragment) {
                    Ok(project) => {
                        self.interface.replace_project(project);
                        self.miss_environment_map();
                    }
                    Err(error) => self.complain(error.to_string()),
                },
                Message::Notice(text) => self.say(text),
                Message::Complaint(text) => self.complain(text),
            }
        }
    }

    /// Opens a file: a scene, a picture that carries one, or an environment map.
    fn open_file(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        // A picture of this program's own opens its scene, whatever else its pixels could light.
        if environment_map::is_environment_map(bytes) && exr_scene(bytes).is_none() {
            let environment_map =
                environment_map::decode(name, bytes).map_err(|error| error.to_string())?;
            self.interface.use_environment_map(Arc::new(environment_map));
            let lights = self.interface.scene().lights.rig.len();
            self.say(format!(
                "{name} lights the scene with {lights} lights, beside those of the list."
            ));
            return Ok(());
        }
        self.interface.replace_project(project_in(bytes)?);
        self.say(format!("Opened {name}."));
        self.miss_environment_map();
        Ok(())
    }

    /// Says which environment map the scene shows, where it is not at hand.
    fn miss_environment_map(&mut self) {
        let scene = self.interface.scene();
        let name = scene.lights.rig.picture.name.clone();
        let is_shown = scene.background.kind == BackgroundKind::Picture;
        if is_shown && !name.is_empty() && self.interface.environment_map().is_none() {
            self.say(format!("The background is {name}, which is not kept with the scene: drop or choose it to see it. Its lights are there."));
        }
    }

    /// Lets go of what the lost GPU held, and keeps the rest. Returns whether a still was lost.
    pub fn lose_gpu(&mut self) -> bool {
        let was_exporting = self.status.is_exporting;
        self.gpu = None;
        self.status = Status { frames: self.status.frames, ..Status::default() };
        self.write_down();
        was_exporting
    }

    /// Keeps the scene and the interface's layout, without waiting for rest.
    pub fn write_down(&mut self) {
        self.autosave.flush();
        match serde_json::to_string(self.interface.settings()) {
            Ok(text) => storage::SETTINGS.write(&text),
            Err(error) => log::warn!("the settings are not kept: {error}"),
        }
    }
}

/// The scene of the address or of the last visit, and what there is to say about an address that
/// could not be read.
fn known_project(address: &Address) -> (Option<Project>, Option<String>) {
    let mut complaint = None;
    if let Some(fragment) = address.read_foreign() {
        match link::project_from_fragment(&fragment) {
            Ok(project) => return (Some(project), None),
            Err(error) => complaint = Some(error.to_string()),
        }
    }
    let stored = storage::SCENE.read().and_then(|text| {
        document::project_from_json(&text)
            .inspect_err(|error| log::warn!("the scene of the last visit cannot be read: {error}"))
            .ok()
    });
    (stored, complaint)
}

/// How the interface is laid out on a first visit. In a narrow window the panel covers most of the
/// picture, and who follows a link comes for that.
fn first_settings(comes_by_link: bool) -> Settings {
    let is_narrow = page::width_px().is_some_and(|width| width < f64::from(theme::WIDE_FROM));
    Settings { panel_open: !(comes_by_link && is_narrow), ..Settings::default() }
}

fn stored_settings() -> Option<Settings> {
    let text = storage::SETTINGS.read();
    text.and_then(|text| {
        serde_json::from_str(&text)
            .inspect_err(|error| {
                log::warn!("the settings of the last visit cannot be read: {error}")
            })
            .ok()
    })
}

/// The scene in a file: a document, or a picture that carries one.
fn project_in(bytes: &[u8]) -> Result<Project, String> {
    let text = if let Some(text) = exr_scene(bytes) {
        text
    } else if export::is_png(bytes) {
        export::scene_text(Cursor::new(bytes))
            .map_err(|error| error.to_string())?
            .ok_or("this picture carries no scene: only pictures saved by Mandelight do")?
    } else {
        String::from_utf8(bytes.to_vec())
            .map_err(|_| "neither a scene document nor a picture that can be read".to_owned())?
    };
    document::project_from_json(&text).map_err(|error| error.to_string())
}

/// The scene document that an OpenEXR file carries.
fn exr_scene(bytes: &[u8]) -> Option<String> {
    export::is_exr(bytes).then(|| export::exr_scene_text(Cursor::new(bytes)).ok()?)?
}
