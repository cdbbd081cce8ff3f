//! The interface for screen readers: `www/accessibility.js` shows its elements as unseen HTML.
//!
//! In: egui's elements. Out: a screen reader's requests, into egui's next frame.

use wasm_bindgen::prelude::*;

use crate::ui::accessibility::{Elements, Request, ScreenReader};

#[wasm_bindgen(js_namespace = mandelightAccessibility)]
extern "C" {
    /// Shows `{elements, focus}` as HTML.
    #[wasm_bindgen(catch)]
    fn show(json: &str) -> Result<(), JsValue>;
    /// Sets who hears of requests: an id, a request's name, and a number.
    #[wasm_bindgen(catch)]
    fn listen(listener: &JsValue) -> Result<(), JsValue>;
}

/// Seconds between two changes: a screen reader speaks no faster.
const INTERVAL_SECS: f64 = 0.2;

/// Connects screen readers with an interface, until another is connected.
pub fn connect(context: &egui::Context) {
    context.add_plugin(ScreenReader::new(show_elements, INTERVAL_SECS));
    let listener = {
        let context = context.clone();
        move |id: String, request: String, value: f64| {
            let request = match request.as_str() {
                "press" => Request::Press,
                "focus" => Request::Focus,
                "set" if value.is_finite() => Request::SetNumber(value),
                _ => return,
            };
            context.plugin::<ScreenReader>().lock().request(&id, &request);
            context.request_repaint();
        }
    };
    let listener = Closure::<dyn FnMut(String, String, f64)>::new(listener).into_js_value();
    log_failure(listen(&listener));
}

fn show_elements(elements: &Elements) {
    match serde_json::to_string(elements) {
        Ok(json) => log_failure(show(&json)),
        Err(error) => log::warn!("the interface for screen readers: {error}"),
    }
}

/// The page works without its accessible copy, so a failure is no one's obstacle.
fn log_failure(outcome: Result<(), JsValue>) {
    if let Err(error) = outcome {
        log::warn!("the interface for screen readers: {}", super::page::describe(&error));
    }
}
