//! Downloads, the file dialogue, dropped files and the clipboard.
//!
//! In: bytes and names. Out: bytes and names, through the mailbox. Does not know what a file means.

use std::io::{self, Write};

use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, HtmlAnchorElement, HtmlInputElement, Url};

use super::{
    mailbox::{Mailbox, Message},
    page::{self, describe, document, window},
};
use crate::scene::{document::MAX_BYTES, environment_map::decode::MAX_FILE_BYTES};

/// Bytes read of a file that may hold a scene. One over a document's limit, so that the decoder
/// refuses a larger document. A picture's scene precedes its pixels.
const MAX_READ_BYTES: f64 = (MAX_BYTES + 1) as f64;

/// Bytes read of an environment map. One over the decoder's limit, so that the decoder refuses a
/// larger file.
const MAX_ENVIRONMENT_MAP_BYTES: f64 = (MAX_FILE_BYTES + 1) as f64;

/// Files in the dialogue, by extension and media type.
const ACCEPTED: &str = ".json,.png,.jpg,.jpeg,.webp,.hdr,.pic,.exr,.ggr,.gpl,.map,.ugr,application/json,image/png,image/jpeg,image/webp";

/// Extensions of environment maps.
const ENVIRONMENT_MAP_EXTENSIONS: [&str; 3] = [".hdr", ".pic", ".exr"];

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
                        read(&file, &mailbox);
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

/// Reads `file` and posts its content.
pub fn read(file: &web_sys::File, mailbox: &Mailbox) {
    let (file, mailbox) = (file.clone(), mailbox.clone());
    spawn_local(async move {
        let name = file.name();
        let content = read_start(&file).await.map_err(|error| describe(&error));
        mailbox.post(Message::File { name, content });
    });
}

/// The first bytes of `file`, as many as its kind needs.
async fn read_start(file: &web_sys::File) -> Result<Vec<u8>, JsValue> {
    let name = file.name().to_lowercase();
    let is_environment_map = ENVIRONMENT_MAP_EXTENSIONS.iter().any(|end| name.ends_with(end));
    let max_bytes = if is_environment_map { MAX_ENVIRONMENT_MAP_BYTES } else { MAX_READ_BYTES };
    let start = file.slice_with_f64_and_f64(0.0, file.size().min(max_bytes))?;
    let buffer = JsFuture::from(start.array_buffer()).await?;
    Ok(js_sys::Uint8Array::new(&buffer).to_vec())
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
                "The link could not be copied ({}). Copy it from the address bar.",
                describe(&error)
            )),
        });
    });
}
