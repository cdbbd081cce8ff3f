//! Downloads, the file dialogue, dropped files and the clipboard.
//!
//! In: bytes and names; files of the visitor. Out: downloads; the same files, through the mailbox. Does not
//! know what a file means.

use std::io::{self, Write};

use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlInputElement, Url};

use super::{
    mailbox::{Mailbox, Message},
    page::{self, describe, document, window},
};

/// Files in the dialogue, by extension and media type.
const ACCEPTED: &str = ".json,.png,.jpg,.jpeg,.webp,.hdr,.pic,.exr,.ggr,.gpl,.map,.ugr,application/json,image/png,image/jpeg,image/webp";

/// Approximate bytes of one blob of a download.
const CHUNK_BYTES: usize = 1 << 20;

/// Milliseconds that a download's URL stays valid. A browser may read the URL after the click.
const REVOKE_AFTER_MS: i32 = 60_000;

/// A download in pieces, so that the module's memory never holds the whole file.
#[derive(Default)]
pub struct Download {
    blobs: js_sys::Array,
    chunk: Vec<u8>,
}

impl Download {
    /// Starts the download, under the name `name`.
    ///
    /// # Errors
    /// The browser's message, mostly that memory is short.
    pub fn finish(mut self, name: &str, mime: &str) -> Result<(), String> {
        self.push_chunk().and_then(|()| self.start(name, mime)).map_err(|error| describe(&error))
    }

    /// Moves the collected bytes into a blob.
    fn push_chunk(&mut self) -> Result<(), JsValue> {
        if !self.chunk.is_empty() {
            let bytes = js_sys::Uint8Array::from(self.chunk.as_slice());
            // A browser can keep blobs on disk, but not arrays.
            self.blobs.push(&Blob::new_with_u8_array_sequence(&js_sys::Array::of1(&bytes))?.into());
            self.chunk.clear();
        }
        Ok(())
    }

    fn start(self, name: &str, mime: &str) -> Result<(), JsValue> {
        let options = BlobPropertyBag::new();
        options.set_type(mime);
        download_blob(name, &Blob::new_with_blob_sequence_and_options(&self.blobs, &options)?)
    }
}

/// Downloads `blob` as a file called `name`.
///
/// # Errors
/// The browser's exception.
pub fn download_blob(name: &str, blob: &Blob) -> Result<(), JsValue> {
    let url = Url::create_object_url_with_blob(blob)?;
    let anchor: HtmlAnchorElement = document()
        .ok_or_else(|| JsValue::from_str("the page has no document"))?
        .create_element("a")?
        .unchecked_into();
    anchor.set_href(&url);
    anchor.set_download(name);
    anchor.click();
    page::after_ms(REVOKE_AFTER_MS, move || {
        // A URL that is already revoked needs nothing more.
        let _ = Url::revoke_object_url(&url);
    });
    Ok(())
}

impl io::Write for Download {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.chunk.extend_from_slice(bytes);
        if self.chunk.len() >= CHUNK_BYTES {
            self.push_chunk().map_err(|error| io::Error::other(describe(&error)))?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Downloads `content` as a file called `name`.
///
/// # Errors
/// Those of [`Download::finish`].
pub fn download(name: &str, mime: &str, content: &[u8]) -> Result<(), String> {
    let mut download = Download::default();
    download.write_all(content).map_err(|error| error.to_string())?;
    download.finish(name, mime)
}

/// The browser's file dialogue, opened through a hidden input element.
pub struct FilePicker {
    input: Option<HtmlInputElement>,
}

impl FilePicker {
    /// A picker that posts each chosen file.
    pub fn new(mailbox: &Mailbox) -> Self {
        let input = create_input();
        match &input {
            Ok(input) => {
                let (source, mailbox) = (input.clone(), mailbox.clone());
                page::listen(input, "change", move || {
                    if let Some(file) = source.files().and_then(|files| files.get(0)) {
                        mailbox.post(Message::File(file));
                    }
                });
            }
            Err(error) => log::warn!("cannot create the file dialogue: {}", describe(error)),
        }
        Self { input: input.ok() }
    }

    /// Opens the dialogue. Browsers allow that only shortly after a click or a key.
    pub fn open(&self) {
        if let Some(input) = &self.input {
            // Cleared, because choosing the same file again fires no event otherwise.
            input.set_value("");
            input.click();
        }
    }
}

fn create_input() -> Result<HtmlInputElement, JsValue> {
    let document = document().ok_or_else(|| JsValue::from_str("the page has no document"))?;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(ACCEPTED);
    input.set_hidden(true);
    // Some browsers open the dialogue only for an element in the document.
    if let Some(body) = document.body() {
        body.append_child(&input)?;
    }
    Ok(input)
}

/// Copies `link` to the clipboard, and posts `notice` on success.
pub fn copy_link(link: String, notice: &str, mailbox: &Mailbox) {
    let (mailbox, notice) = (mailbox.clone(), notice.to_owned());
    let Some(window) = window() else { return };
    spawn_local(async move {
        let clipboard = window.navigator().clipboard();
        // On pages without TLS the property is missing, despite its type.
        let outcome = if clipboard.is_undefined() {
            Err(JsValue::from_str("the browser gives this page no access to the clipboard"))
        } else {
            JsFuture::from(clipboard.write_text(&link)).await
        };
        mailbox.post(match outcome {
            Ok(_) => Message::Notice(notice),
            Err(error) => Message::Error(format!(
                "The link could not be copied. Copy it from the address bar. ({})",
                describe(&error)
            )),
        });
    });
}
