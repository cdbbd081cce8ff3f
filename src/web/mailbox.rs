//! A queue of messages from the browser's callbacks to the next frame.
//!
//! In: messages, at any moment. Out: the same messages, once a frame. A callback can run in the
//! middle of a frame, so it posts a message and requests a repaint instead of touching the app.

use std::{cell::RefCell, rc::Rc};

use super::file_content::FileContent;
use crate::ui::GalleryState;

/// An event from outside a frame.
pub enum Message {
    /// The visitor picked or dropped a file.
    File(web_sys::File),
    /// A file has been decoded.
    Decoded {
        /// The ticket of its decoder.
        ticket: u32,
        /// What it holds, or why it could not be read.
        content: Result<FileContent, String>,
    },
    /// The visitor changed the address's fragment, given without `#`.
    Fragment(String),
    /// A view to keep: its document, and a small picture as a JPEG file.
    Favourite {
        /// The project's document.
        document: String,
        /// The picture's file.
        jpeg: Vec<u8>,
    },
    /// Another tab has changed the browser's storage.
    Storage,
    /// The gallery of the address has been read, or can't be.
    Gallery(GalleryState),
    /// A picture of the gallery has been fetched.
    GalleryPicture {
        /// The ticket of its decoder.
        ticket: u32,
        /// The picture's name.
        name: String,
        /// The file's start, which holds the scene, or why it could not be read.
        content: Result<web_sys::Blob, String>,
    },
    /// A success to show to the visitor.
    Notice(String),
    /// A failure to show to the visitor.
    Error(String),
}

/// A queue of messages to the app. Clones share one queue.
#[derive(Clone, Default)]
pub struct Mailbox {
    inner: Rc<RefCell<Inner>>,
}

#[derive(Default)]
struct Inner {
    messages: Vec<Message>,
    context: Option<egui::Context>,
}

impl Mailbox {
    /// Sets the egui context to repaint; each new device has its own.
    pub fn set_context(&self, context: &egui::Context) {
        self.inner.borrow_mut().context = Some(context.clone());
    }

    /// Queues a message and requests a repaint.
    pub fn post(&self, message: Message) {
        self.inner.borrow_mut().messages.push(message);
        self.wake();
    }

    /// Requests a repaint.
    pub fn wake(&self) {
        // Cloned first: the context may call back into the mailbox.
        let context = self.inner.borrow().context.clone();
        if let Some(context) = context {
            context.request_repaint();
        }
    }

    /// Takes all messages, oldest first.
    pub fn take(&self) -> Vec<Message> {
        std::mem::take(&mut self.inner.borrow_mut().messages)
    }
}
