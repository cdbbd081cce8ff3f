//! Which videos the browser can encode, for the choice of a file.
//!
//! In: the video that the timeline would save. Out: the kinds that the browser cannot encode. Browsers
//! answer later; until then the last answer holds.

use std::{cell::Cell, rc::Rc};

use js_sys::Promise;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};

use super::{mailbox::Mailbox, page::describe};
use crate::ui::{MissingEncoders, VideoSpec};

#[wasm_bindgen]
extern "C" {
    /// Loads `www/codecs.js`.
    #[wasm_bindgen(catch, js_namespace = window, js_name = mandelightCodecs)]
    fn load() -> Result<Promise, JsValue>;

    /// The loaded script.
    type Script;
    /// Whether the browser encodes videos of any kind.
    #[wasm_bindgen(method, catch, js_name = isSupported)]
    fn is_supported(this: &Script) -> Result<bool, JsValue>;
    /// Resolves with whether the browser encodes such videos.
    #[wasm_bindgen(method, catch, js_name = canEncode)]
    fn can_encode(
        this: &Script,
        container: &str,
        width: u32,
        height: u32,
        frames_per_second: u32,
    ) -> Result<Promise, JsValue>;
}

/// What the browser can encode.
#[derive(Default)]
pub struct VideoSupport {
    /// The video of the last check.
    checked: Option<VideoSpec>,
    answer: Rc<Answer>,
}

#[derive(Default)]
struct Answer {
    is_pending: Cell<bool>,
    missing: Cell<MissingEncoders>,
}

impl VideoSupport {
    /// The kinds that the browser cannot encode, as far as it has answered.
    pub fn missing(&self) -> MissingEncoders {
        self.answer.missing.get()
    }

    /// Checks `video` unless that is done; the answer requests a repaint. One check at a time.
    pub fn check(&mut self, video: Option<VideoSpec>, mailbox: &Mailbox) {
        let Some(spec) = video.filter(|_| video != self.checked && !self.answer.is_pending.get())
        else {
            return;
        };
        self.checked = video;
        self.answer.is_pending.set(true);
        let (answer, mailbox) = (self.answer.clone(), mailbox.clone());
        spawn_local(async move {
            match missing_for(spec).await {
                Ok(missing) => answer.missing.set(missing),
                // Then a video that can't be encoded fails at its start, with a message.
                Err(error) => {
                    answer.missing.set(MissingEncoders::None);
                    log::warn!("the check of encoders: {}", describe(&error));
                }
            }
            answer.is_pending.set(false);
            mailbox.wake();
        });
    }
}

async fn missing_for(spec: VideoSpec) -> Result<MissingEncoders, JsValue> {
    let script: Script = JsFuture::from(load()?).await?.unchecked_into();
    if !script.is_supported()? {
        return Ok(MissingEncoders::All);
    }
    let VideoSpec { size_px: [width, height], frames_per_second } = spec;
    let mut is_missing = [false; 2];
    for (missing, container) in is_missing.iter_mut().zip(["mp4", "webm"]) {
        let answer = script.can_encode(container, width, height, frames_per_second)?;
        *missing = JsFuture::from(answer).await?.is_falsy();
    }
    let [mp4, webm] = is_missing;
    Ok(MissingEncoders::OfThisSize { mp4, webm })
}
