//! Autosave: writes the scene and its path to the browser's storage and the address bar.
//!
//! In: the edited project of each frame. Out: one write, half a second after the last change. The undo
//! steps are written too, so that a reload does not end them.

use crate::{
    scene::{Project, document, link},
    ui::editor::Editor,
};

use super::{address::Address, storage};

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
}

impl Autosave {
    /// An autosave that skips the first project: that one is stored already, or the default.
    pub fn new(address: Address) -> Self {
        Self { address, last: None, changed_at_secs: None }
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
        storage::SCENE.write(&document::project_to_json_compact(project));
        storage::STEPS.write(&steps_to_text(editor.steps()));
        // An address is too short for a long path: then it holds the scene alone.
        let fragment = link::project_to_fragment(project);
        match fragment.or_else(|_| link::to_fragment(&project.scene)) {
            Ok(fragment) => self.address.write(&fragment),
            Err(error) => log::warn!("the address bar cannot hold this scene: {error}"),
        }
    }
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
