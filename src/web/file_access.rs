//! A file that is written while it is made: the browser's save dialogue and the stream behind it.
//!
//! In: bytes. Out: a file on the visitor's disk, there under its name when it is closed. The
//! browser writes behind; [`DiskFile::is_behind`] says when to wait. Not every browser has this:
//! its parts are looked up by name.

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
    page::{self, call_with, describe, settled},
};

/// Bytes are handed over in pieces of about this size.
const PIECE_BYTES: usize = 1 << 20;

/// Bytes on their way to the disk at which to wait.
const BEHIND_BYTES: usize = 16 << 20;

/// Whether this browser writes files while they are made.
pub fn is_there() -> bool {
    page::window().is_some_and(|window| {
        Reflect::get(&window, &"showSaveFilePicker".into()).is_ok_and(|f| f.is_function())
    })
}

/// Why there is no file.
pub enum NoFile {
    /// The visitor closed the dialogue.
    NotChosen,
    /// The browser refused.
    Refused(String),
}

/// A file in the making. Dropped before its end, it is given up.
#[derive(Clone)]
pub struct DiskFile(Rc<Inner>);

struct Inner {
    handle: JsValue,
    stream: JsValue,
    piece: RefCell<Vec<u8>>,
    waiting_bytes: Cell<usize>,
    fault: RefCell<Option<String>>,
    is_closed: Cell<bool>,
}

impl DiskFile {
    /// Asks the visitor for a file of the given kind. The browser allows it only shortly after a
    /// click or a key.
    pub async fn choose(name: &str, mime: &str, ending: &str) -> Result<Self, NoFile> {
        let refused = |error: JsValue| match name_of(&error).as_deref() {
            Some("AbortError") => NoFile::NotChosen,
            _ => NoFile::Refused(describe(&error)),
        };
        let window = JsValue::from(page::window());
        let options = options(name, mime, ending);
        let asked = call_with(&window, "showSaveFilePicker", &Array::of1(&options));
        let handle = settled(asked).await.map_err(refused)?;
        let opened = call_with(&handle, "createWritable", &Array::new());
        let stream = settled(opened).await.map_err(refused)?;
        Ok(Self(Rc::new(Inner {
            handle,
            stream,
            piece: RefCell::default(),
            waiting_bytes: Cell::new(0),
            fault: RefCell::default(),
            is_closed: Cell::new(false),
        })))
    }

    /// Whether the disk has to catch up before more is made.
    pub fn is_behind(&self) -> bool {
        self.0.waiting_bytes.get() > BEHIND_BYTES
    }

    /// Writes the rest, closes the file, and posts how that went.
    pub fn finish(self, name: String, mailbox: &Mailbox) {
        let mailbox = mailbox.clone();
        self.send();
        self.0.is_closed.set(true);
        let closed = call_with(&self.0.stream, "close", &Array::new());
        spawn_local(async move {
            let outcome = settled(closed).await.map_err(|error| describe(&error));
            let fault = self.0.fault.borrow_mut().take();
            mailbox.post(match outcome.and(fault.map_or(Ok(()), Err)) {
                Ok(()) => Message::Notice(format!("Saved {name}.")),
                Err(reason) => Message::Complaint(format!("{name} was not saved: {reason}")),
            });
        });
    }

    /// Hands what has gathered to the browser.
    fn send(&self) {
        let piece = std::mem::take(&mut *self.0.piece.borrow_mut());
        if piece.is_empty() {
            return;
        }
        let inner = self.0.clone();
        inner.waiting_bytes.set(inner.waiting_bytes.get() + piece.len());
        // A copy on JavaScript's side: the module's own memory may move meanwhile.
        let bytes = Uint8Array::from(piece.as_slice());
        let written = call_with(&inner.stream, "write", &Array::of1(&bytes));
        spawn_local(async move {
            if let Err(error) = settled(written).await {
                inner.fault.borrow_mut().get_or_insert_with(|| describe(&error));
            }
            inner.waiting_bytes.set(inner.waiting_bytes.get() - piece.len());
        });
    }
}

impl io::Write for DiskFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if let Some(fault) = &*self.0.fault.borrow() {
            return Err(io::Error::other(fault.clone()));
        }
        self.0.piece.borrow_mut().extend_from_slice(bytes);
        if self.0.piece.borrow().len() >= PIECE_BYTES {
            self.send();
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        if self.is_closed.get() {
            return;
        }
        let aborted = call_with(&self.stream, "abort", &Array::new());
        let handle = self.handle.clone();
        spawn_local(async move {
            // The file is the stream's until that has let go of it, well or not.
            if let Err(error) = settled(aborted).await {
                log::warn!("abort: {}", describe(&error));
            }
            // The dialogue has made an empty file of that name.
            page::call(&handle, "remove");
        });
    }
}

/// What the dialogue proposes: `{suggestedName, types: [{accept: {mime: [ending]}}]}`.
fn options(name: &str, mime: &str, ending: &str) -> JsValue {
    let object = |key: &str, value: &JsValue| {
        let object = Object::new();
        // Setting a property of a plain object does not fail.
        let _ = Reflect::set(&object, &key.into(), value);
        object
    };
    let accept = object(mime, &Array::of1(&ending.into()));
    let kind = object("accept", &accept);
    let options = object("types", &Array::of1(&kind));
    let _ = Reflect::set(&options, &"suggestedName".into(), &name.into());
    options.into()
}

/// The name of a thrown error.
fn name_of(error: &JsValue) -> Option<String> {
    Reflect::get(error, &"name".into()).ok()?.as_string()
}
