//! A video that is made frame by frame: `www/video.js` encodes it and writes its file.
//!
//! In: rows of pixels. Out: a file on the visitor's disk, or a download. The browser encodes
//! asynchronously; [`Video::is_busy`] says when to wait.

use std::{
    cell::{Cell, RefCell},
    rc::Rc,
};

use js_sys::{Promise, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::{
    file_access::{ChosenFile, closed_message},
    files,
    mailbox::{Mailbox, Message},
    page::describe,
};
use crate::export::{ExportError, FrameSink};

#[wasm_bindgen]
extern "C" {
    /// Loads `www/video.js`, which most visits never need.
    #[wasm_bindgen(catch, js_namespace = window, js_name = mandelightVideo)]
    fn load() -> Result<Promise, JsValue>;

    /// The loaded script.
    type Script;
    /// Starts a video; without a stream, in memory.
    #[wasm_bindgen(method, catch)]
    fn open(
        this: &Script,
        container: &str,
        width: u32,
        height: u32,
        frames_per_second: u32,
        stream: &JsValue,
    ) -> Result<Promise, JsValue>;

    /// A video of the script.
    type Encoder;
    /// Adds a frame; resolves once the next may come.
    #[wasm_bindgen(method)]
    fn add(this: &Encoder, rgb: Uint8Array) -> Promise;
    /// Ends the video; resolves with the file, if it is in memory.
    #[wasm_bindgen(method)]
    fn finish(this: &Encoder) -> Promise;
    /// Stops.
    #[wasm_bindgen(method)]
    fn cancel(this: &Encoder) -> Promise;
}

/// The message about a video that failed.
pub fn failure(reason: &str) -> String {
    format!(
        "The video could not be saved: {reason}. Save it again, in a smaller size or as PNGs, which need no encoder."
    )
}

/// A video that is being made. Clones share it; dropping the last one unfinished deletes its file.
#[derive(Clone)]
pub struct Video(Rc<Inner>);

struct Inner {
    encoder: Encoder,
    /// The file on the disk; `None` for a download.
    file: Option<ChosenFile>,
    mailbox: Mailbox,
    is_busy: Cell<bool>,
    is_finished: Cell<bool>,
    /// Why the last frame could not be encoded.
    error: RefCell<Option<String>>,
}

impl Video {
    /// Starts a video in a `container`, `mp4` or `webm`, with frames of `size_px` pixels.
    ///
    /// # Errors
    /// The browser's refusal: of the size, of the container, or of all videos.
    pub async fn open(
        container: &str,
        size_px: [u32; 2],
        frames_per_second: u32,
        file: Option<ChosenFile>,
        mailbox: &Mailbox,
    ) -> Result<Self, String> {
        let open = async {
            let script: Script = JsFuture::from(load()?).await?.unchecked_into();
            let stream = file.as_ref().map_or(JsValue::UNDEFINED, |file| file.stream().clone());
            let [width, height] = size_px;
            let opened = script.open(container, width, height, frames_per_second, &stream)?;
            JsFuture::from(opened).await.map(JsCast::unchecked_into)
        };
        let encoder = open.await.map_err(|error: JsValue| describe(&error))?;
        Ok(Self(Rc::new(Inner {
            encoder,
            file,
            mailbox: mailbox.clone(),
            is_busy: Cell::new(false),
            is_finished: Cell::new(false),
            error: RefCell::default(),
        })))
    }

    /// Whether the next frame has to wait.
    pub fn is_busy(&self) -> bool {
        self.0.is_busy.get()
    }

    /// Ends the video, and posts a message about the file called `name`.
    pub fn finish(self, name: String) {
        self.0.is_finished.set(true);
        let finished = JsFuture::from(self.0.encoder.finish());
        spawn_local(async move {
            let finished = finished.await;
            // A frame that could not be added is missing in a file that is whole otherwise.
            let finished = match self.0.error.take() {
                Some(error) => Err(JsValue::from(error)),
                None => finished,
            };
            let saved = match (finished, &self.0.file) {
                (Ok(_), Some(file)) => {
                    file.keep();
                    Ok(())
                }
                (Ok(blob), None) => files::download_blob(&name, blob.unchecked_ref()),
                (Err(error), _) => Err(error),
            };
            self.0.mailbox.post(match saved {
                Ok(()) => closed_message(&name, Ok(())),
                Err(error) => Message::Error(failure(&describe(&error))),
            });
        });
    }
}

impl FrameSink for Video {
    fn add(&mut self, _name: &str, rgb: Vec<u8>) -> Result<(), ExportError> {
        if let Some(error) = self.0.error.take() {
            return Err(ExportError::Encode(error));
        }
        self.0.is_busy.set(true);
        let added = JsFuture::from(self.0.encoder.add(Uint8Array::from(rgb.as_slice())));
        let inner = self.0.clone();
        spawn_local(async move {
            if let Err(error) = added.await {
                *inner.error.borrow_mut() = Some(describe(&error));
            }
            inner.is_busy.set(false);
            inner.mailbox.wake();
        });
        Ok(())
    }
}

impl Drop for Inner {
    fn drop(&mut self) {
        if self.is_finished.get() {
            return;
        }
        let cancelled = JsFuture::from(self.encoder.cancel());
        spawn_local(async move {
            if let Err(error) = cancelled.await {
                log::warn!("the video could not be stopped: {}", describe(&error));
            }
        });
    }
}
