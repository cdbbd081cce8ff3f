//! `window.mandelight`: the object by which browser tests drive the page, with `?test` only.
//!
//! In: calls from JavaScript. Out: plain objects. Except for losing the device, failing decoders and ending the
//! program, a visitor can do all that the hook does. It also locates the widgets, which a canvas hides from a browser.

use std::{cell::RefCell, rc::Rc};

use js_sys::{Array, Float32Array, Object, Promise, Reflect, Uint8Array};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;

use super::{decoder::Fault, error_log, page, session::Session, view_picture::read_pixels};
use crate::{gpu::Gpu, render::Activity, scene::document, ui::zoom};

/// The page's test hook.
#[wasm_bindgen]
pub struct TestHook {
    session: Rc<RefCell<Session>>,
}

impl TestHook {
    /// Sets `window.mandelight`.
    pub fn install(session: &Rc<RefCell<Session>>) {
        let Some(window) = page::window() else { return };
        let hook = JsValue::from(Self { session: session.clone() });
        set(&window, "mandelight", hook);
    }
}

#[wasm_bindgen]
impl TestHook {
    /// The view's report, as an object: counts, milliseconds and pixels.
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
        let idle = report.is_finished() && session.status.texture.is_some();
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
        set(&object, "dispatches", status.dispatches as f64);
        set(&object, "frames", status.frames as f64);
        set(&object, "exporting", status.exported.is_some());
        set(&object, "exported", status.exported.unwrap_or(0.0));
        set(&object, "smallPictures", status.small_pictures as f64);
        set(&object, "smallPicturesLeft", status.has_small_pictures_left);
        set(&object, "uiTextures", status.ui_textures as f64);
        set(&object, "reading", session.decoder.is_busy());
        set(&object, "memoryBytes", memory_bytes());
        object
    }

    /// The scene in view and its path, as a document.
    pub fn scene(&self) -> String {
        document::project_to_json(self.session.borrow().interface.project())
    }

    /// Shows the scene of a document; throws a description of the document's error.
    #[wasm_bindgen(js_name = setScene)]
    pub fn set_scene(&self, json: &str) -> Result<(), JsValue> {
        let project = document::project_from_json(json)
            .map_err(|error| JsValue::from_str(&error.to_string()))?;
        let mut session = self.session.borrow_mut();
        session.interface.replace_project(project);
        session.mailbox.wake();
        Ok(())
    }

    /// The picture's pixels, read back from the GPU: `{width, height, data}`, RGBA, top row first.
    pub fn pixels(&self) -> Promise {
        let session = self.session.borrow();
        let source = session.gpu.clone().zip(session.status.texture.clone());
        future_to_promise(async move {
            let (gpu, texture) =
                source.ok_or_else(|| JsValue::from_str("there is no picture yet"))?;
            read_back(&gpu, &texture).await.map(JsValue::from)
        })
    }

    /// The loaded environment map: `{name, width, height, pixels}`; null without one.
    #[wasm_bindgen(js_name = environmentMap)]
    pub fn environment_map(&self) -> JsValue {
        let session = self.session.borrow();
        let Some(map) = session.interface.environment_map() else { return JsValue::NULL };
        let object = Object::new();
        let channels: Vec<f32> = map.pixels().iter().flat_map(|it| it.to_array()).collect();
        set(&object, "name", map.name());
        set(&object, "width", map.size_px()[0]);
        set(&object, "height", map.size_px()[1]);
        set(&object, "pixels", Float32Array::from(channels.as_slice()));
        object.into()
    }

    /// Makes the decoder of the next file fail: `panic`, `loop` or `memory`. After `max_secs` it is given up.
    #[wasm_bindgen(js_name = breakDecoder)]
    pub fn break_decoder(&self, kind: String, max_secs: f64) {
        self.session.borrow_mut().decoder.fault = Some(Fault { kind, max_secs });
    }

    /// Destroys the device, as a driver's reset would.
    #[wasm_bindgen(js_name = loseDevice)]
    pub fn lose_device(&self) {
        let gpu = self.session.borrow().gpu.clone();
        if let Some(gpu) = gpu {
            gpu.device.destroy();
        }
    }

    /// Ends the program within a frame, as an error in it would.
    #[wasm_bindgen(js_name = endProgram)]
    pub fn end_program(&self) {
        let _frame = self.session.borrow_mut();
        panic!("a panic of the test");
    }

    /// Whether the page has a device: not after a loss, until the restart.
    #[wasm_bindgen(js_name = hasDevice)]
    pub fn has_device(&self) -> bool {
        self.session.borrow().gpu.is_some()
    }

    /// The widgets' rectangles: name to `{x, y, width, height}` in CSS pixels.
    #[wasm_bindgen(js_name = uiRects)]
    pub fn ui_rects(&self) -> Object {
        let object = Object::new();
        for (name, rect) in self.session.borrow().interface.rects().iter() {
            let bounds = Object::new();
            set(&bounds, "x", rect.min.x);
            set(&bounds, "y", rect.min.y);
            set(&bounds, "width", rect.width());
            set(&bounds, "height", rect.height());
            set(&object, name, bounds);
        }
        object
    }

    /// Panics and errors of this visit: `{count, messages}`.
    pub fn errors(&self) -> Object {
        let log = error_log::snapshot();
        let object = Object::new();
        set(&object, "count", log.count);
        set(
            &object,
            "messages",
            log.messages.iter().map(|text| JsValue::from_str(text)).collect::<Array>(),
        );
        object
    }
}

/// Size of the module's memory, which only grows.
fn memory_bytes() -> f64 {
    let memory = wasm_bindgen::memory().dyn_into::<js_sys::WebAssembly::Memory>();
    let buffer = memory.map(|memory| memory.buffer().unchecked_into::<js_sys::ArrayBuffer>());
    buffer.map_or(0.0, |buffer| f64::from(buffer.byte_length()))
}

/// Reads the texture's pixels: `{width, height, data}`.
async fn read_back(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Object, JsValue> {
    let bytes = read_pixels(gpu, texture).await?;
    let object = Object::new();
    set(&object, "width", texture.width());
    set(&object, "height", texture.height());
    set(&object, "data", Uint8Array::from(bytes.as_slice()));
    Ok(object)
}

fn set(object: &JsValue, name: &str, value: impl Into<JsValue>) {
    // Setting a property of a plain object does not fail.
    let _ = Reflect::set(object, &JsValue::from_str(name), &value.into());
}
