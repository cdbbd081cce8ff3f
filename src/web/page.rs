//! The browser's window: clocks, timers, listeners, the query, the notice over the page.
//!
//! In: nothing. Out: values; `None` where a browser withholds one. Knows neither scenes nor the
//! interface.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Document, Window};

#[wasm_bindgen]
extern "C" {
    /// The boot script's notice over the page, which needs no GPU.
    #[wasm_bindgen(catch, js_namespace = window, js_name = mandelightNotice)]
    fn mandelight_notice(text: &str, detail: &str) -> Result<(), JsValue>;
    /// Its notice that the program has ended by an error.
    #[wasm_bindgen(catch, js_namespace = window, js_name = mandelightStop)]
    fn mandelight_stop(reason: &str) -> Result<(), JsValue>;
}

/// The browser's window; `None` only in a worker, where nothing but decoding runs.
pub fn window() -> Option<Window> {
    web_sys::window()
}

/// The window's width and height in CSS pixels.
pub fn size_px() -> Option<[f64; 2]> {
    let window = window()?;
    Some([window.inner_width().ok()?.as_f64()?, window.inner_height().ok()?.as_f64()?])
}

/// True if the visitor asks for as little motion on the screen as possible.
pub fn prefers_reduced_motion() -> bool {
    let query = "(prefers-reduced-motion: reduce)";
    let list = window().and_then(|window| window.match_media(query).ok()?);
    list.is_some_and(|list| list.matches())
}

/// The window's document.
pub fn document() -> Option<Document> {
    window()?.document()
}

/// Seconds since the page was opened; never goes back.
pub fn now_secs() -> f64 {
    window().and_then(|window| window.performance()).map_or(0.0, |clock| clock.now() / 1000.0)
}

/// Seconds since 1970, comparable across reloads.
pub fn epoch_secs() -> f64 {
    js_sys::Date::now() / 1000.0
}

/// Whether the address's query contains `test`, which installs the test hook.
pub fn is_test() -> bool {
    window()
        .and_then(|window| window.location().search().ok())
        .is_some_and(|search| search.trim_start_matches('?').split('&').any(|word| word == "test"))
}

/// Whether the page is hidden: behind another tab, or in a minimised window.
pub fn is_hidden() -> bool {
    document().is_some_and(|document| document.hidden())
}

/// Shows `text` and `detail` over the page, for when the interface cannot be drawn.
pub fn show_notice(text: &str, detail: &str) {
    if mandelight_notice(text, detail).is_err() {
        log::error!("{text}: {detail}");
    }
}

/// Shows that the program has ended by an error in it, for a `reason` in a programmer's words.
pub fn show_stop(reason: &str) {
    if mandelight_stop(reason).is_err() {
        log::error!("the program has ended: {reason}");
    }
}

/// Enters or leaves fullscreen. Does nothing where the browser refuses.
pub fn toggle_fullscreen() {
    let Some(document) = document() else { return };
    match document.document_element().filter(|_| document.fullscreen_element().is_none()) {
        Some(root) => call_and_log(&root, "requestFullscreen"),
        None => call_and_log(&document, "exitFullscreen"),
    }
}

/// Calls a method that a browser may lack, and logs a failure.
pub fn call_and_log(target: &JsValue, method: &'static str) {
    let outcome = call(target, method, &js_sys::Array::new());
    spawn_local(async move {
        if let Err(error) = resolve(outcome).await {
            log::warn!("{method} failed: {}", describe(&error));
        }
    });
}

/// Calls a method that a browser may lack.
///
/// # Errors
/// The method's exception, or a `TypeError` where the method is missing.
pub fn call(target: &JsValue, method: &str, arguments: &js_sys::Array) -> Result<JsValue, JsValue> {
    js_sys::Reflect::get(target, &JsValue::from_str(method))?
        .dyn_into::<js_sys::Function>()?
        .apply(target, arguments)
}

/// The final value of a call that may have returned a promise.
///
/// # Errors
/// The call's exception, or the promise's rejection.
pub async fn resolve(outcome: Result<JsValue, JsValue>) -> Result<JsValue, JsValue> {
    JsFuture::from(js_sys::Promise::resolve(&outcome?)).await
}

/// Calls `action` once after `delay_ms` milliseconds.
pub fn after_ms(delay_ms: i32, action: impl FnOnce() + 'static) {
    let Some(window) = window() else { return };
    let callback = Closure::once_into_js(action);
    if let Err(error) = window
        .set_timeout_with_callback_and_timeout_and_arguments_0(callback.unchecked_ref(), delay_ms)
    {
        log::warn!("the browser set no timer: {}", describe(&error));
    }
}

/// Calls `action` at every `event` of `target` for as long as the page lives.
pub fn listen(target: &web_sys::EventTarget, event: &str, action: impl FnMut() + 'static) {
    let callback = Closure::<dyn FnMut()>::new(action);
    match target.add_event_listener_with_callback(event, callback.as_ref().unchecked_ref()) {
        // No listener is ever removed, so leaking the closure is right.
        Ok(()) => callback.forget(),
        Err(error) => log::warn!("the browser added no {event} listener: {}", describe(&error)),
    }
}

/// A thrown JavaScript value as text.
pub fn describe(value: &JsValue) -> String {
    match value.dyn_ref::<js_sys::Error>() {
        Some(error) => String::from(error.message()),
        None => value.as_string().unwrap_or_else(|| format!("{value:?}")),
    }
}
