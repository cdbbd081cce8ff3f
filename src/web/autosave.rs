//! Autosave: writes the scene and its path to the browser's storage and the address bar.
//!
//! In: the edited project of each frame. Out: one write, half a second after the last change. The undo
//! steps are written too, so that a reload does not end them. Each tab has a copy of its own for reloads, since
//! all tabs share the scene that the next visit opens with.

use crate::{
    scene::{
        Project, document,
        last_visit::{self, Opened, StoredTexts},
        link,
    },
    ui::editor::Editor,
};

use super::{
    address::Address,
    scene_watch,
    storage::{self, StorageKey},
};

/// Seconds without a change before a write.
const REST_SECS: f64 = 0.5;
/// Maximum length of the stored undo steps, in bytes; browsers store about 5 MB per page.
const MAX_STEPS_BYTES: usize = 500_000;
/// Maximum number of stored undo steps, so that a write takes no longer than a frame.
const MAX_STORED_STEPS: usize = 50;

/// The autosave of one project.
pub struct Autosave {
    address: Address,
    /// The project of the last frame. `None` before the first, which fits the camera to the window.
    last: Option<Project>,
    /// When the last unsaved change was seen, on the page's clock.
    changed_at_secs: Option<f64>,
    /// The document that was written last.
    written: Option<String>,
    has_failed: bool,
}

impl Autosave {
    /// An autosave that skips the first project: that one is stored already, or the default.
    pub fn new(address: Address) -> Self {
        let (written, has_failed) = (None, false);
        Self { address, last: None, changed_at_secs: None, written, has_failed }
    }

    /// Compares this frame's project with the last one, and writes it when due. Returns the seconds
    /// until the next call is due, if a write is pending. While `moving`, writes wait.
    pub fn update(&mut self, editor: &Editor, moving: bool, now_secs: f64) -> Option<f64> {
        let project = editor.project();
        if self.last.as_ref() != Some(project) {
            let is_first = self.last.replace(project.clone()).is_none();
            self.changed_at_secs = (!is_first).then_some(now_secs);
        } else if moving && self.changed_at_secs.is_some() {
            self.changed_at_secs = Some(now_secs);
        }
        let left_secs = self.changed_at_secs? + REST_SECS - now_secs;
        if left_secs > 0.0 {
            return Some(left_secs);
        }
        self.flush(editor);
        None
    }

    /// Writes the project of the last frame now, if it has unsaved changes.
    pub fn flush(&mut self, editor: &Editor) {
        if self.changed_at_secs.is_some()
            && let Some(project) = self.last.take()
        {
            self.write_project(&project, editor);
            self.last = Some(project);
        }
    }

    /// Writes the edited project now, whether it has changed or not.
    pub fn write(&mut self, editor: &Editor) {
        self.write_project(editor.project(), editor);
        self.last = Some(editor.project().clone());
    }

    fn write_project(&mut self, project: &Project, editor: &Editor) {
        self.changed_at_secs = None;
        // Noted before the storage names it: the next frame may be the last.
        scene_watch::watch(&project.scene);
        let document = document::project_to_json_compact(project);
        self.has_failed |= !key_for_scene(self.written.as_deref()).write(&document);
        storage::STEPS.write(&steps_to_text(editor.steps()));
        // An address is too short for a long path: then it holds the scene alone.
        let fragment = link::project_to_fragment(project);
        match fragment.or_else(|_| link::to_fragment(&project.scene)) {
            Ok(fragment) => self.address.write(&fragment),
            Err(error) => log::warn!("the address bar cannot hold this scene: {error}"),
        }
        let fragment = Address::read().unwrap_or_default();
        self.has_failed |= !storage::TAB_SCENE.write(&last_visit::tab_text(&fragment, &document));
        self.written = Some(document);
    }

    /// True once after a write that the storage refused.
    pub fn take_failure(&mut self) -> bool {
        std::mem::take(&mut self.has_failed)
    }
}

/// The scene to open, and what is said of stored scenes that cannot be opened.
pub fn stored_scene() -> Opened {
    let fragment = Address::read();
    let [tab, last, older] =
        [storage::TAB_SCENE, storage::SCENE, storage::OLDER_SCENE].map(StorageKey::read);
    last_visit::open(&StoredTexts {
        fragment: fragment.as_deref(),
        tab: tab.as_deref(),
        last: last.as_deref(),
        older: older.as_deref(),
    })
}

/// Where the scene is stored: a newer version's document stays where it is.
///
/// `written` is what this tab wrote last, which needs no look at its version.
fn key_for_scene(written: Option<&str>) -> StorageKey {
    let stored = storage::SCENE.read().filter(|stored| Some(stored.as_str()) != written);
    let is_newer = stored.is_some_and(|stored| document::is_newer(&stored));
    if is_newer { storage::OLDER_SCENE } else { storage::SCENE }
}

/// The undo steps of the last visit in this tab, the most recent last.
pub fn stored_steps() -> Vec<Project> {
    let text = storage::STEPS.read().unwrap_or_default();
    // A step that cannot be read ends the steps that can be undone.
    let steps = text.lines().map_while(|line| document::project_from_json(line).ok());
    let mut steps: Vec<Project> = steps.collect();
    steps.reverse();
    steps
}

/// Undo steps as documents, one a line, the most recent first, as many as have room.
fn steps_to_text<'a>(steps: impl Iterator<Item = &'a Project>) -> String {
    let mut text = String::new();
    for step in steps.take(MAX_STORED_STEPS) {
        let line = document::project_to_json_compact(step);
        if text.len() + line.len() > MAX_STEPS_BYTES {
            break;
        }
        text.push_str(&line);
        text.push('\n');
    }
    text
}
