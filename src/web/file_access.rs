//! A file on the visitor's disk, written while its content is made (File System Access API).
//!
//! In: bytes. Out: a file, complete once it is closed. The browser writes asynchronously;
//! [`DiskFile::is_backlogged`] says when to wait. Not every browser has this API, so its methods
//! are looked up by name.

use std::{
    cell::{Cell, RefCell},
    io,
    rc::Rc,
};

use js_sys::{Array, Object, Reflect, Uint8Array};
use wasm_bindgen::JsValue;
use wasm_bindgen_futures::spawn_local;

use super::{
    mailbox::{Mailbox, Message},
    page::{self, call, describe, resolve},
};

/// Approximate bytes of one write.
const CHUNK_BYTES: usize = 1 << 20;

/// Unwritten bytes above which [`DiskFile::is_backlogged`].
const MAX_PENDING_BYTES: usize = 16 << 20;

/// Whether this browser has the API.
pub fn is_supported() -> bool {
    page::window().is_some_and(|window| {
        Reflect::get(&window, &"showSaveFilePicker".into()).is_ok_and(|f| f.is_function())
    })
}

/// Why [`DiskFile::choose`] returned no file.
pub enum ChooseError {
    /// The visitor closed the dialogue.
    Cancelled,
    /// The browser refused, with its reason.
    Refused(String),
}

/// A file that the visitor has chosen to write. Unless it is kept, dropping it deletes it.
pub struct ChosenFile {
    /// The `FileSystemFileHandle`.
    handle: JsValue,
    /// The `FileSystemWritableFileStream`.
    stream: JsValue,
    is_kept: Cell<bool>,
}

impl ChosenFile {
    /// Opens the save dialogue. Browsers allow that only shortly after a click or a key.
    ///
    /// # Errors
    /// The visitor's or the browser's refusal.
    pub async fn choose(name: &str, mime: &str, extension: &str) -> Result<Self, ChooseError> {
        let choose_error = |error: JsValue| match error_name(&error).as_deref() {
            Some("AbortError") => ChooseError::Cancelled,
            _ => ChooseError::Refused(describe(&error)),
        };
        let window = JsValue::from(page::window());
        let options = dialogue_options(name, mime, extension);
        let chosen = call(&window, "showSaveFilePicker", &Array::of1(&options));
        let handle = resolve(chosen).await.map_err(choose_error)?;
        let opened = call(&handle, "createWritable", &Array::new());
        let stream = resolve(opened).await.map_err(choose_error)?;
        Ok(Self { handle, stream, is_kept: Cell::new(false) })
    }

    /// The `FileSystemWritableFileStream`, for another writer.
    pub fn stream(&self) -> &JsValue {
        &self.stream
    }

    /// Marks the file as complete.
    pub fn keep(&self) {
        self.is_kept.set(true);
    }
}

/// The message about a file that is closed, or could not be.
pub fn closed_message(name: &str, outcome: Result<(), String>) -> Message {
    match outcome {
        Ok(()) => Message::Notice(format!("Saved {name}.")),
        Err(reason) => Message::Error(format!(
            "{name} could not be saved. Check the free space on the disk, then save again. ({reason})"
        )),
    }
}

/// A file that is being written. Clones share it; dropping the last one unfinished deletes it.
#[derive(Clone)]
pub struct DiskFile(Rc<Inner>);

struct Inner {
    file: ChosenFile,
    /// Bytes that were not handed to the stream yet.
    chunk: RefCell<Vec<u8>>,
    /// Bytes that the stream has not written yet.
    pending_bytes: Cell<usize>,
    /// The first error of a write.
    error: RefCell<Option<String>>,
}

impl DiskFile {
    /// Starts to write a file.
    pub fn new(file: ChosenFile) -> Self {
        Self(Rc::new(Inner {
            file,
            chunk: RefCell::default(),
            pending_bytes: Cell::new(0),
            error: RefCell::default(),
        }))
    }

    /// Whether the browser has over 16 MiB left to write.
    pub fn is_backlogged(&self) -> bool {
        self.0.pending_bytes.get() > MAX_PENDING_BYTES
    }

    /// Writes the last bytes, closes the file, and posts a notice about `name`.
    pub fn finish(self, name: String, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        self.write_chunk();
        self.0.file.keep();
        let closed = call(&self.0.file.stream, "close", &Array::new());
        spawn_local(async move {
            let outcome = resolve(closed).await.map_err(|error| describe(&error));
            let write_error = self.0.error.borrow_mut().take();
            let outcome = outcome.map(drop).and(write_error.map_or(Ok(()), Err));
            mailbox.post(closed_message(&name, outcome));
        });
    }

    /// Hands the collected bytes to the stream.
    fn write_chunk(&self) {
        let chunk = std::mem::take(&mut *self.0.chunk.borrow_mut());
        if chunk.is_empty() {
            return;
        }
        let inner = self.0.clone();
        inner.pending_bytes.set(inner.pending_bytes.get() + chunk.len());
        // A copy in JavaScript's memory: the module's own memory can move before the write.
        let bytes = Uint8Array::from(chunk.as_slice());
        let written = call(&inner.file.stream, "write", &Array::of1(&bytes));
        spawn_local(async move {
            if let Err(error) = resolve(written).await {
                inner.error.borrow_mut().get_or_insert_with(|| describe(&error));
            }
            inner.pending_bytes.set(inner.pending_bytes.get() - chunk.len());
        });
    }
}

impl io::Write for DiskFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(error) = &*self.0.error.borrow() {
            return Err(io::Error::other(error.clone()));
        }
        self.0.chunk.borrow_mut().extend_from_slice(bytes);
        if self.0.chunk.borrow().len() >= CHUNK_BYTES {
            self.write_chunk();
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Drop for ChosenFile {
    fn drop(&mut self) {
        if self.is_kept.get() {
            return;
        }
        let aborted = call(&self.stream, "abort", &Array::new());
        let handle = self.handle.clone();
        spawn_local(async move {
            // The stream locks the file until the abort has ended, even if it fails.
            if let Err(error) = resolve(aborted).await {
                log::warn!("abort failed: {}", describe(&error));
            }
            // The save dialogue created an empty file.
            page::call_and_log(&handle, "remove");
        });
    }
}

/// The dialogue's options: `{suggestedName, types: [{accept: {mime: [extension]}}]}`.
fn dialogue_options(name: &str, mime: &str, extension: &str) -> JsValue {
    let object = |key: &str, value: &JsValue| {
        let object = Object::new();
        // Setting a property of a plain object does not fail.
        let _ = Reflect::set(&object, &key.into(), value);
        object
    };
    let accept = object(mime, &Array::of1(&extension.into()));
    let file_type = object("accept", &accept);
    let options = object("types", &Array::of1(&file_type));
    let _ = Reflect::set(&options, &"suggestedName".into(), &name.into());
    options.into()
}

/// The `name` property of a thrown error.
fn error_name(error: &JsValue) -> Option<String> {
    Reflect::get(error, &"name".into()).ok()?.as_string()
}
