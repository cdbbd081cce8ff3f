//! When directional lights and a sky's sun have handles in the view: while a person works on lights, and shortly after.

use egui::{Event, Response, Ui};

/// Seconds for which the handles stay after the last use: long enough to reach one from the panel.
const STAY_SECS: f64 = 6.0;

/// True in a frame in which the keyboard reaches a control or a key is pressed at it.
///
/// A control that merely keeps the focus is not in use: the focus stays where it is until something else gets it.
pub fn is_used_by_keyboard(control: &Response) -> bool {
    let is_pressed = |event: &Event| matches!(event, Event::Key { pressed: true, .. });
    control.gained_focus()
        || control.has_focus() && control.ctx.input(|input| input.events.iter().any(is_pressed))
}

/// Whether directional lights have handles in the view.
#[derive(Debug, Default)]
pub struct LightHandles {
    until_secs: f64,
}

impl LightHandles {
    /// True if the handles are shown; `is_in_use` is true if a control of a light is in use in this frame.
    pub fn are_shown(&mut self, ui: &Ui, is_in_use: bool) -> bool {
        if is_in_use {
            self.keep(ui);
        }
        let left_secs = self.until_secs - ui.input(|input| input.time);
        if left_secs > 0.0 {
            ui.ctx().request_repaint_after_secs(left_secs as f32);
        }
        left_secs > 0.0
    }

    /// Shows the handles for some more seconds.
    pub fn keep(&mut self, ui: &Ui) {
        self.until_secs = ui.input(|input| input.time) + STAY_SECS;
    }
}
