//! Keeps the scene in view and its path: in the browser's storage and in the address, once it has
//! come to rest.
//!
//! In: scene and path of each frame. Out: writes, about half a second after the last change.

use crate::scene::{Project, document, link};

use super::{address::Address, storage};

/// Rest before anything is written, seconds.
const REST_SECS: f64 = 0.5;

/// Watches one scene for changes.
pub struct Autosave {
    address: Address,
    /// The scene of the last frame; none before the first, which fits the view to the window.
    seen: Option<Project>,
    changed_at_secs: Option<f64>,
}

impl Autosave {
    /// Starts to watch. The first scene seen is not written: it is kept where it came from.
    pub fn new(address: Address) -> Self {
        Self { address, seen: None, changed_at_secs: None }
    }

    /// Looks at this frame's scene and path and writes them if it is due. Returns after how many
    /// seconds to look again, if anything is still to be written.
    pub fn watch(&mut self, project: &Project, moving: bool, now_secs: f64) -> Option<f64> {
        if self.seen.as_ref() != Some(project) {
            let is_first = self.seen.replace(project.clone()).is_none();
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

    /// Writes the scene of the last frame, if that was not done yet.
    pub fn flush(&mut self) {
        let Some(project) = self.seen.as_ref().filter(|_| self.changed_at_secs.is_some()) else {
            return;
        };
        self.changed_at_secs = None;
        storage::SCENE.write(&document::project_to_json_compact(project));
        // An address has room for any common scene, but not for every path.
        let fragment = link::project_to_fragment(project);
        match fragment.or_else(|_| link::to_fragment(&project.scene)) {
            Ok(fragment) => self.address.write(&fragment),
            Err(error) => log::warn!("the address does not hold this scene: {error}"),
        }
    }
}
