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
use crate::{
    reading::visible,
    ui::file_progress::{FileInProgress, FileProgress, SHOWN_AFTER_SECS, SceneUse},
};

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

/// Seconds after which a file is given up: far more than the largest takes, for slow devices.
const MAX_SECS: f64 = 60.0;

/// A fault of the worker, for tests.
pub struct Fault {
    /// How it fails: `panic`, `loop` or `memory`.
    pub kind: String,
    /// Seconds after which the file is given up.
    pub max_secs: f64,
}

/// The decoder of files, at rest or at work on one.
#[derive(Default)]
pub struct Decoder {
    progress: FileProgress,
    /// The fault of the next file, for tests.
    pub fault: Option<Fault>,
}

impl Decoder {
    /// Reads `file` instead of the one being read. Posts [`Message::Decoded`].
    pub fn start(&mut self, name: String, file: Blob, purpose: SceneUse, mailbox: &Mailbox) {
        let ticket = self.reserve(&name, purpose, mailbox);
        self.decode(ticket, name, file, mailbox);
    }

    /// Ends the reading of another file for one that is yet to be fetched. Returns its ticket for [`Self::decode`].
    pub fn reserve(&mut self, name: &str, purpose: SceneUse, mailbox: &Mailbox) -> u32 {
        self.cancel();
        // The interface shows a file that takes long, also while nothing else moves.
        let waking = mailbox.clone();
        page::after_ms((1000.0 * SHOWN_AFTER_SECS) as i32 + 1, move || waking.wake());
        self.progress.start(visible(name).into_owned(), purpose, page::now_secs())
    }

    /// Reads the file of `ticket`, unless a newer one or a cancellation replaced it. Posts [`Message::Decoded`].
    pub fn decode(&mut self, ticket: u32, name: String, file: Blob, mailbox: &Mailbox) {
        if !self.progress.is_current(ticket) {
            return;
        }
        let (fault, mailbox) = (self.fault.take(), mailbox.clone());
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
        let was_reading = self.progress.cancel();
        if was_reading {
            cancel();
        }
        was_reading
    }

    /// The file of `ticket`, which is read now; none if a newer one or a cancellation replaced it.
    pub fn finish(&mut self, ticket: u32) -> Option<FileInProgress> {
        self.progress.finish(ticket)
    }

    /// The name of a file that takes long to read.
    pub fn slow_file(&self, now_secs: f64) -> Option<&str> {
        self.progress.slow_file(now_secs)
    }

    /// Whether a file is being read.
    pub fn is_busy(&self) -> bool {
        self.progress.is_busy()
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
