//! The browser's storage: texts that outlive a visit or a reload.
//!
//! In: keys and texts. Out: the stored texts. A blocked or full storage logs one warning and is no
//! error: the page works without it.

use std::cell::Cell;

use super::page::{describe, window};
use crate::scene::{Scene, document, link};

/// The scene in view, as a document.
pub const SCENE: StorageKey =
    StorageKey { name: "mandelight.scene", lifetime: Lifetime::Permanent };
/// This version's scene while [`SCENE`] holds a newer version's document.
pub const OLDER_SCENE: StorageKey =
    StorageKey { name: "mandelight.scene.older", lifetime: Lifetime::Permanent };
/// This tab's address and document, as `last_visit` writes them.
pub const TAB_SCENE: StorageKey = StorageKey { name: "mandelight.tab", lifetime: Lifetime::Tab };
/// The interface's settings, as JSON.
pub const SETTINGS: StorageKey =
    StorageKey { name: "mandelight.settings", lifetime: Lifetime::Permanent };
/// The views that the visitor keeps, as JSON.
pub const FAVOURITES: StorageKey =
    StorageKey { name: "mandelight.favourites", lifetime: Lifetime::Permanent };
/// A list of views that could not be read.
pub const FAVOURITES_DAMAGED: StorageKey =
    StorageKey { name: "mandelight.favourites.damaged", lifetime: Lifetime::Permanent };
/// The undo steps, as documents, one a line.
pub const STEPS: StorageKey = StorageKey { name: "mandelight.steps", lifetime: Lifetime::Tab };
/// The times of GPU losses and the scene of the last one, as JSON.
pub const LOSSES: StorageKey =
    StorageKey { name: "mandelight.losses", lifetime: Lifetime::Permanent };

/// The scenes that the next visit offers instead of opening, as JSON.
pub const UNFINISHED: StorageKey =
    StorageKey { name: "mandelight.unfinished", lifetime: Lifetime::Permanent };

/// A scene as text, by which stored lists know it: its link, or its document if too large for one.
pub fn scene_text(scene: &Scene) -> String {
    link::to_fragment(scene).unwrap_or_else(|_| document::to_json_compact(scene))
}

/// A key of the browser's storage.
#[derive(Clone, Copy)]
pub struct StorageKey {
    name: &'static str,
    lifetime: Lifetime,
}

#[derive(Clone, Copy)]
enum Lifetime {
    /// Until the visitor clears the storage.
    Permanent,
    /// Across reloads of one tab.
    Tab,
}

thread_local! {
    static HAS_WARNED: Cell<bool> = const { Cell::new(false) };
}

impl StorageKey {
    /// The stored text.
    pub fn read(self) -> Option<String> {
        // A blocked storage throws here already.
        self.open()?.get_item(self.name).ok()?
    }

    /// Stores `text`, and returns whether it is stored: a full or blocked storage keeps the old text.
    pub fn write(self, text: &str) -> bool {
        let outcome = self.open().map(|storage| storage.set_item(self.name, text));
        let reason = match outcome {
            Some(Ok(())) => return true,
            Some(Err(error)) => describe(&error),
            None => "the browser blocks it".to_owned(),
        };
        if !HAS_WARNED.replace(true) {
            log::warn!("cannot write to the browser's storage: {reason}");
        }
        false
    }

    fn open(self) -> Option<web_sys::Storage> {
        let window = window()?;
        match self.lifetime {
            Lifetime::Permanent => window.local_storage().ok()?,
            Lifetime::Tab => window.session_storage().ok()?,
        }
    }
}
