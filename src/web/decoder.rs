//! The file that is being decoded, apart from the page: one at a time, the newest.
//!
//! In: a file. Out: a message with what it holds, or why it could not be read. A worker decodes it
//! (`www/decoder.js`); a newer file, a cancellation or the limit of time ends that worker.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::Blob;

use super::{
    decode_worker::MAX_MEMORY_BYTES,
    file_content::FileContent,
    mailbox::{Mailbox, Message},
    page::{self, describe},
};
use crate::reading::visible;

// The functions of `www/decoder.js`, which `boot.js` puts there.
#[wasm_bindgen(js_namespace = mandelightDecoder)]
extern "C" {
    #[wasm_bindgen(catch)]
    async fn decode(
        module: &JsValue,
        name: &str,
        file: &Blob,
        limits: &JsValue,
    ) -> Result<JsValue, JsValue>;
    fn cancel();
}

/// Seconds after which a file is given up.
const MAX_SECS: f64 = 60.0;
/// Seconds after which the interface says that a file is read: most files are read sooner.
const SHOWN_AFTER_SECS: f64 = 0.3;

/// What to do with a scene that was read.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum SceneUse {
    /// Show it at once.
    Open,
    /// Fly to it: a picture of the gallery.
    FlyInto,
}

/// A fault of the worker, for tests.
pub struct Fault {
    /// How it fails: `panic`, `loop` or `memory`.
    pub kind: String,
    /// Seconds after which the file is given up.
    pub max_secs: f64,
}

/// A file that is being read.
pub struct FileInProgress {
    /// The file's name, without control characters.
    pub name: String,
    /// What to do with its scene.
    pub purpose: SceneUse,
    ticket: u32,
    since_secs: f64,
}

/// The decoder of files, at rest or at work on one.
#[derive(Default)]
pub struct Decoder {
    reading: Option<FileInProgress>,
    tickets: u32,
    /// The fault of the next file, for tests.
    pub fault: Option<Fault>,
}

impl Decoder {
    /// Reads `file` instead of the one being read. Posts [`Message::Decoded`].
    pub fn start(&mut self, name: String, file: Blob, purpose: SceneUse, mailbox: &Mailbox) {
        self.tickets = self.tickets.wrapping_add(1);
        let (ticket, mailbox) = (self.tickets, mailbox.clone());
        let since_secs = page::now_secs();
        let shown = visible(&name).into_owned();
        self.reading = Some(FileInProgress { name: shown, purpose, ticket, since_secs });
        let fault = self.fault.take();
        // The interface shows a file that takes long, also while nothing else moves.
        let waking = mailbox.clone();
        page::after_ms((1000.0 * SHOWN_AFTER_SECS) as i32 + 1, move || waking.wake());
        spawn_local(async move {
            let max_secs = fault.as_ref().map_or(MAX_SECS, |fault| fault.max_secs);
            let limits = limits(max_secs, fault);
            let parcel = decode(&wasm_bindgen::module(), &name, &file, &limits).await;
            let content = parcel
                .map_err(|error| describe(&error))
                .and_then(|parcel| FileContent::unpack(&parcel));
            mailbox.post(Message::Decoded { ticket, content });
        });
    }

    /// Stops reading. Returns whether a file was being read.
    pub fn cancel(&mut self) -> bool {
        let was_reading = self.reading.take().is_some();
        if was_reading {
            cancel();
        }
        was_reading
    }

    /// The file of `ticket`, which is read now; none if a newer one or a cancellation replaced it.
    pub fn finish(&mut self, ticket: u32) -> Option<FileInProgress> {
        self.reading.take_if(|reading| reading.ticket == ticket)
    }

    /// The name of a file that takes long to read.
    pub fn slow_file(&self, now_secs: f64) -> Option<&str> {
        let reading = self.reading.as_ref()?;
        (now_secs - reading.since_secs > SHOWN_AFTER_SECS).then_some(reading.name.as_str())
    }

    /// Whether a file is being read.
    pub fn is_busy(&self) -> bool {
        self.reading.is_some()
    }
}

/// The limits of `www/decoder.js`: `{secs, mebibytes, fault}`.
fn limits(max_secs: f64, fault: Option<Fault>) -> JsValue {
    let object = js_sys::Object::new();
    let set = |name: &str, value: JsValue| {
        // Setting a property of a plain object does not fail.
        let _ = js_sys::Reflect::set(&object, &JsValue::from_str(name), &value);
    };
    set("secs", max_secs.into());
    set("mebibytes", ((MAX_MEMORY_BYTES >> 20) as u32).into());
    if let Some(fault) = fault {
        set("fault", fault.kind.into());
    }
    object.into()
}
