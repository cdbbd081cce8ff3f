//! The address bar: its fragment holds the scene in view, so that copying the address shares the view.
//!
//! In: fragments to write. Out: fragments that the visitor typed or followed. `scene::link` encodes
//! and decodes them.

use std::{cell::RefCell, rc::Rc};

use wasm_bindgen::JsValue;

use super::{
    mailbox::{Mailbox, Message},
    page::{self, describe, window},
};

/// The page's address. Clones share the last written fragment.
#[derive(Clone, Default)]
pub struct Address {
    written: Rc<RefCell<Option<String>>>,
}

impl Address {
    /// The fragment without `#`; `None` if it is empty or this page wrote it.
    pub fn read_foreign(&self) -> Option<String> {
        let is_own = |fragment: &String| self.written.borrow().as_ref() == Some(fragment);
        Self::read().filter(|fragment| !is_own(fragment))
    }

    /// The fragment without `#`; `None` if it is empty.
    pub fn read() -> Option<String> {
        let hash = window()?.location().hash().ok()?;
        let fragment = hash.strip_prefix('#').unwrap_or(&hash);
        // Some programs percent-encode the fragment when they pass an address on.
        let decoded = js_sys::decode_uri_component(fragment).ok().map(String::from);
        let fragment = decoded.as_deref().unwrap_or(fragment);
        (!fragment.is_empty()).then(|| fragment.to_owned())
    }

    /// Writes `fragment` (without `#`) to the address, without an entry in the tab's history.
    pub fn write(&self, fragment: &str) {
        let Some(history) = window().and_then(|window| window.history().ok()) else { return };
        match history.replace_state_with_url(&JsValue::NULL, "", Some(&format!("#{fragment}"))) {
            Ok(()) => *self.written.borrow_mut() = Some(fragment.to_owned()),
            // Browsers limit how often this is allowed; the next autosave tries again.
            Err(error) => log::warn!("cannot write to the address bar: {}", describe(&error)),
        }
    }

    /// The page's whole address with `fragment` in place of its own.
    pub fn with_fragment(fragment: &str) -> Option<String> {
        let href = window()?.location().href().ok()?;
        let base = href.split('#').next().unwrap_or_default();
        Some(format!("{base}#{fragment}"))
    }

    /// Posts every fragment that the visitor types or follows from now on.
    pub fn watch(&self, mailbox: &Mailbox) {
        let Some(window) = window() else { return };
        let (address, mailbox) = (self.clone(), mailbox.clone());
        page::listen(&window, "hashchange", move || {
            if let Some(fragment) = address.read_foreign() {
                mailbox.post(Message::Fragment(fragment));
            }
        });
    }
}
