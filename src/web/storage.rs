//! What the browser keeps between visits: text under a few keys.
//!
//! In: keys and text. Out: the text that was there, if any. A blocked or full storage is a console
//! note, said once, and never an error: the page works without it.

use std::cell::Cell;

use super::page::{describe, window};

/// The scene in view, as a document.
pub const SCENE: Shelf = Shelf { key: "mandelight.scene", kind: Kind::Lasting };
/// How the interface is laid out.
pub const SETTINGS: Shelf = Shelf { key: "mandelight.settings", kind: Kind::Lasting };
/// When the GPU was lost, and with which scene; forgotten with the tab.
pub const LOSSES: Shelf = Shelf { key: "mandelight.losses", kind: Kind::Tab };

/// One place for text in the browser's storage.
#[derive(Clone, Copy)]
pub struct Shelf {
    key: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    /// Kept until the visitor clears it.
    Lasting,
    /// Kept across reloads of one tab.
    Tab,
}

thread_local! {
    static COMPLAINED: Cell<bool> = const { Cell::new(false) };
}

impl Shelf {
    /// The text kept here.
    pub fn read(self) -> Option<String> {
        // A blocked storage throws already here.
        self.open()?.get_item(self.key).ok()?
    }

    /// Keeps `text` here; a full or blocked storage keeps what it had.
    pub fn write(self, text: &str) {
        let outcome = self.open().map(|storage| storage.set_item(self.key, text));
        let reason = match outcome {
            Some(Ok(())) => return,
            Some(Err(error)) => describe(&error),
            None => "it is blocked".to_owned(),
        };
        if !COMPLAINED.replace(true) {
            log::warn!("the browser's storage keeps nothing of this visit: {reason}");
        }
    }

    fn open(self) -> Option<web_sys::Storage> {
        let window = window()?;
        match self.kind {
            Kind::Lasting => window.local_storage().ok()?,
            Kind::Tab => window.session_storage().ok()?,
        }
    }
}
