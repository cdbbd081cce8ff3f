//! `window.mandelight`: what a browser test drives the page by, there only when the address asks
//! for it (`?test`). egui has no accessibility tree on the web, so a test cannot find widgets.
//!
//! In: calls from JavaScript. Out: plain objects. It can do nothing that a person at the page
//! could not do, but for losing the device.

use std::{cell::RefCell, rc::Rc};

use js_sys::{Array, Object, Promise, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, future_to_promise};

use super::{faults, page, session::Session};
use crate::{
    gpu::{Gpu, readback::Readback},
    render::Activity,
    scene::document,
    ui::zoom,
};

/// Between two looks for pixels that are on their way, milliseconds.
const LOOK_EVERY_MS: i32 = 4;

/// The test hook.
#[wasm_bindgen]
pub struct TestHook {
    session: Rc<RefCell<Session>>,
}

impl TestHook {
    /// Puts a hook on the window.
    pub fn install(session: &Rc<RefCell<Session>>) {
        let Some(window) = page::window() else { return };
        let hook = JsValue::from(Self { session: session.clone() });
        set(&window, "mandelight", hook);
    }
}

#[wasm_bindgen]
impl TestHook {
    /// What the view is doing: counts, milliseconds and pixels.
    pub fn report(&self) -> Object {
        let session = self.session.borrow();
        let status = &session.status;
        let report = &status.report;
        let object = Object::new();
        let activity = match &report.activity {
            Activity::Idle => "idle".to_owned(),
            Activity::Moving => "moving".to_owned(),
            Activity::Refining => "refining".to_owned(),
            Activity::Compiling(what) => format!("compiling {what}"),
        };
        // An idle view without a picture has not begun.
        let idle = report.activity == Activity::Idle
            && session.status.texture.is_some()
            && report.pictures > 0;
        set(&object, "activity", activity);
        set(&object, "idle", idle);
        set(&object, "samplesDone", report.samples_done);
        set(&object, "samplesWanted", report.samples_wanted);
        set(&object, "width", report.size_px[0]);
        set(&object, "height", report.size_px[1]);
        set(&object, "pictures", report.pictures as f64);
        set(&object, "pixelsPerSample", report.pixels_per_sample);
        set(&object, "elapsedSecs", report.elapsed_secs);
        set(&object, "frameMs", report.frame_ms);
        set(&object, "anchorMs", report.anchor_ms);
        set(&object, "zoom", zoom(&session.interface.scene().camera));
        set(&object, "dispatches", status.dispatches.total() as f64);
        set(&object, "frames", status.frames as f64);
        set(&object, "exporting", status.is_exporting);
        object
    }

    /// The scene in view with its path, as a document.
    pub fn scene(&self) -> String {
        document::project_to_json(self.session.borrow().interface.project())
    }

    /// Puts a scene document in view; throws what is wrong with it.
    #[wasm_bindgen(js_name = setScene)]
    pub fn set_scene(&self, json: &str) -> Result<(), JsValue> {
        let project = document::project_from_json(json)
            .map_err(|error| JsValue::from_str(&error.to_string()))?;
        let mut session = self.session.borrow_mut();
        session.interface.replace_project(project);
        session.mailbox.wake();
        Ok(())
    }

    /// The picture's pixels, read back from the GPU: `{width, height, data}`, RGBA, from the top.
    pub fn pixels(&self) -> Promise {
        let session = self.session.borrow();
        let source = session.gpu.clone().zip(session.status.texture.clone());
        future_to_promise(async move {
            let (gpu, texture) =
                source.ok_or_else(|| JsValue::from_str("there is no picture yet"))?;
            read_back(&gpu, &texture).await.map(JsValue::from)
        })
    }

    /// Loses the GPU, as a driver's reset would.
    #[wasm_bindgen(js_name = loseDevice)]
    pub fn lose_device(&self) {
        let gpu = self.session.borrow().gpu.clone();
        if let Some(gpu) = gpu {
            gpu.device.destroy();
        }
    }

    /// Where the interface's widgets are: name to `{x, y, width, height}` in CSS pixels.
    #[wasm_bindgen(js_name = uiRects)]
    pub fn ui_rects(&self) -> Object {
        let object = Object::new();
        for (name, rect) in self.session.borrow().interface.rects().iter() {
            let place = Object::new();
            set(&place, "x", rect.min.x);
            set(&place, "y", rect.min.y);
            set(&place, "width", rect.width());
            set(&place, "height", rect.height());
            set(&object, name, place);
        }
        object
    }

    /// Panics and errors of this visit: `{count, messages}`.
    pub fn errors(&self) -> Object {
        let faults = faults::so_far();
        let object = Object::new();
        set(&object, "count", faults.count);
        set(
            &object,
            "messages",
            faults.messages.iter().map(|text| JsValue::from_str(text)).collect::<Array>(),
        );
        object
    }
}

async fn read_back(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Object, JsValue> {
    let size_px = [texture.width(), texture.height()];
    let mut readback = Readback::texture(gpu, texture, size_px);
    loop {
        let arrived = readback.take(gpu).map_err(|error| JsValue::from_str(&error.to_string()))?;
        if let Some(bytes) = arrived {
            let object = Object::new();
            set(&object, "width", size_px[0]);
            set(&object, "height", size_px[1]);
            set(&object, "data", Uint8Array::from(bytes.as_slice()));
            return Ok(object);
        }
        rest(LOOK_EVERY_MS).await?;
    }
}

/// Waits without blocking the page.
async fn rest(delay_ms: i32) -> Result<(), JsValue> {
    let promise = Promise::new(&mut |resolve, _| {
        page::after_ms(delay_ms, move || {
            // A promise's own resolve function does not throw.
            let _ = resolve.call0(&JsValue::UNDEFINED);
        });
    });
    JsFuture::from(promise).await.map(|_| ())
}

fn set(object: &JsValue, name: &str, value: impl Into<JsValue>) {
    // Setting a property of a plain object does not fail.
    let _ = Reflect::set(object, &JsValue::from_str(name), &value.into());
}
