//! Files in and out of the page: downloads, the file picker, dropped files, the clipboard.
//!
//! In: bytes and names. Out: bytes and names, by the mailbox. What is in a file is not known here.

use std::io::{self, Write};

use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlInputElement, Url};

use super::{
    mailbox::{Mailbox, Message},
    page::{self, describe, document, window},
};
use crate::scene::{document::MAX_BYTES, environment_map::decode::MAX_FILE_BYTES};

/// As much as is read of a file that may hold a scene: one byte more than of a document, so that
/// what is too large is known as such. A picture carries its scene ahead of its pixels.
const MAX_READ_BYTES: f64 = (MAX_BYTES + 1) as f64;

/// Largest environment map: one byte more than is decoded, so that what is too
/// large is known as such.
const MAX_PANORAMA_BYTES: f64 = (MAX_FILE_BYTES + 1) as f64;

/// How the names of environment maps end.
const PANORAMA_ENDINGS: [&str; 3] = [".hdr", ".pic", ".exr"];

/// A download is handed over in pieces of about this size.
const PIECE_BYTES: usize = 1 << 20;

/// A browser may still be reading a download when the click returns; this long it stays valid.
const REVOKE_AFTER_MS: i32 = 60_000;

/// A file that is handed to the browser piece by piece, so that it never stands whole in the
/// module's own memory.
#[derive(Default)]
pub struct Download {
    parts: js_sys::Array,
    piece: Vec<u8>,
}

impl Download {
    /// Offers the whole as a download called `name`.
    ///
    /// # Errors
    /// What the browser says, mostly of memory.
    pub fn finish(mut self, name: &str, mime: &str) -> Result<(), String> {
        self.hand_over().and_then(|()| self.offer(name, mime)).map_err(|error| describe(&error))
    }

    fn hand_over(&mut self) -> Result<(), JsValue> {
        if !self.piece.is_empty() {
            let bytes = js_sys::Uint8Array::from(self.piece.as_slice());
            // A blob for each piece lets the browser move it out of memory.
            self.parts.push(&Blob::new_with_u8_array_sequence(&js_sys::Array::of1(&bytes))?.into());
            self.piece.clear();
        }
        Ok(())
    }

    fn offer(self, name: &str, mime: &str) -> Result<(), JsValue> {
        let options = BlobPropertyBag::new();
        options.set_type(mime);
        let blob = Blob::new_with_blob_sequence_and_options(&self.parts, &options)?;
        let url = Url::create_object_url_with_blob(&blob)?;
        let anchor: HtmlAnchorElement = document()
            .ok_or_else(|| JsValue::from_str("there is no document"))?
            .create_element("a")?
            .unchecked_into();
        anchor.set_href(&url);
        anchor.set_download(name);
        anchor.click();
        page::after_ms(REVOKE_AFTER_MS, move || {
            // An address that is already gone needs no revoking.
            let _ = Url::revoke_object_url(&url);
        });
        Ok(())
    }
}

impl io::Write for Download {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.piece.extend_from_slice(bytes);
        if self.piece.len() >= PIECE_BYTES {
            self.hand_over().map_err(|error| io::Error::other(describe(&error)))?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Offers `text` as a download called `name`.
pub fn download_text(name: &str, mime: &str, text: &str) -> Result<(), String> {
    let mut download = Download::default();
    download.write_all(text.as_bytes()).map_err(|error| error.to_string())?;
    download.finish(name, mime)
}

/// The browser's file dialogue, through an input element that is never shown.
pub struct Picker {
    input: Option<HtmlInputElement>,
}

impl Picker {
    /// Prepares a picker that posts what is chosen.
    pub fn new(mailbox: &Mailbox) -> Self {
        let input = make_input();
        match &input {
            Ok(input) => {
                let (chosen, mailbox) = (input.clone(), mailbox.clone());
                page::listen(input, "change", move || {
                    if let Some(file) = chosen.files().and_then(|files| files.get(0)) {
                        read(&file, &mailbox);
                    }
                });
            }
            Err(error) => log::warn!("no file picker: {}", describe(error)),
        }
        Self { input: input.ok() }
    }

    /// Opens the dialogue. The browser allows it only shortly after a click or a key.
    pub fn open(&self) {
        if let Some(input) = &self.input {
            // Emptied, so that choosing the same file again is a change.
            input.set_value("");
            input.click();
        }
    }
}

fn make_input() -> Result<HtmlInputElement, JsValue> {
    let document = document().ok_or_else(|| JsValue::from_str("there is no document"))?;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(".json,.png,.hdr,.pic,.exr,application/json,image/png");
    input.set_hidden(true);
    // Some browsers open the dialogue only for an element that is in the page.
    if let Some(body) = document.body() {
        body.append_child(&input)?;
    }
    Ok(input)
}

/// Reads `file` and posts it.
pub fn read(file: &web_sys::File, mailbox: &Mailbox) {
    let (file, mailbox) = (file.clone(), mailbox.clone());
    spawn_local(async move {
        let name = file.name();
        let content = read_start(&file).await.map_err(|error| describe(&error));
        mailbox.post(Message::File { name, content });
    });
}

async fn read_start(file: &web_sys::File) -> Result<Vec<u8>, JsValue> {
    let name = file.name().to_lowercase();
    let is_environment_map = PANORAMA_ENDINGS.iter().any(|ending| name.ends_with(ending));
    let most = if is_environment_map { MAX_PANORAMA_BYTES } else { MAX_READ_BYTES };
    let start = file.slice_with_f64_and_f64(0.0, file.size().min(most))?;
    let buffer = JsFuture::from(start.array_buffer()).await?;
    Ok(js_sys::Uint8Array::new(&buffer).to_vec())
}

/// Copies `text` to the clipboard and posts whether that went well.
pub fn copy_text(text: String, said_when_done: &str, mailbox: &Mailbox) {
    let (mailbox, done) = (mailbox.clone(), said_when_done.to_owned());
    let Some(window) = window() else { return };
    spawn_local(async move {
        let clipboard = window.navigator().clipboard();
        // The property is missing on pages without TLS, whatever its type says.
        let outcome = if clipboard.is_undefined() {
            Err(JsValue::from_str("this page may not use the clipboard"))
        } else {
            JsFuture::from(clipboard.write_text(&text)).await
        };
        mailbox.post(match outcome {
            Ok(_) => Message::Notice(done),
            Err(error) => Message::Complaint(format!(
                "The link was not copied ({}). Copy it from the address bar.",
                describe(&error)
            )),
        });
    });
}
