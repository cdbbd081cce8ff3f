//! Autosave: writes the scene and its path to the browser's storage and the address bar.
//!
//! In: the project of each frame. Out: one write, half a second after the last change.

use crate::scene::{Project, document, link};

use super::{address::Address, storage};

/// Seconds without a change before a write.
const REST_SECS: f64 = 0.5;

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
    pub fn update(&mut self, project: &Project, moving: bool, now_secs: f64) -> Option<f64> {
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
        self.flush();
        None
    }

    /// Writes the project of the last frame now, if it has unsaved changes.
    pub fn flush(&mut self) {
        let Some(project) = self.last.as_ref().filter(|_| self.changed_at_secs.is_some()) else {
            return;
        };
        self.changed_at_secs = None;
        storage::SCENE.write(&document::project_to_json_compact(project));
        // An address is too short for a long path: then it holds the scene alone.
        let fragment = link::project_to_fragment(project);
        match fragment.or_else(|_| link::to_fragment(&project.scene)) {
            Ok(fragment) => self.address.write(&fragment),
            Err(error) => log::warn!("the address bar cannot hold this scene: {error}"),
        }
    }
}
