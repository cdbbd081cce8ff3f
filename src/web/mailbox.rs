//! What reaches the app between two frames: files, links, outcomes of things that took a while.
//!
//! The browser calls back at moments when the app may be in the middle of a frame. Callbacks
//! therefore only leave a message and ask for a frame; the app reads its messages when it starts one.

use std::{cell::RefCell, rc::Rc};

/// Something that happened outside a frame.
pub enum Message {
    /// A file was picked or dropped.
    File {
        /// Its name, for messages.
        name: String,
        /// Its content, or why it could not be read.
        content: Result<Vec<u8>, String>,
    },
    /// The address's fragment was changed by someone else.
    Fragment(String),
    /// Something to tell the person at the page.
    Notice(String),
    /// The same, of something that failed.
    Complaint(String),
}

/// Messages on their way to the app. Clones share the same box.
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
    /// Says whom to wake; a new app after a lost device replaces the one before.
    pub fn wakes(&self, context: &egui::Context) {
        self.inner.borrow_mut().context = Some(context.clone());
    }

    /// Leaves a message and asks for a frame.
    pub fn post(&self, message: Message) {
        self.inner.borrow_mut().messages.push(message);
        self.wake();
    }

    /// Asks for a frame.
    pub fn wake(&self) {
        // Cloned first: the context may call back while it wakes.
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
