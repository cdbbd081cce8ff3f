//! Brings a control into sight that was asked for by name.

use egui::{Id, Ui};

/// Frames in which the control must be drawn: its section opens first.
const FRAMES: u64 = 10;

/// Asks for the control or section called `name`, which brings itself into sight when it is drawn.
pub fn reveal(ui: &Ui, name: &'static str) {
    let until = ui.ctx().cumulative_frame_nr() + FRAMES;
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique("reveal"), (name, until)));
    ui.ctx().request_repaint();
}

/// True once for the control or section that was asked for.
pub fn revealed(ui: &Ui, name: &str) -> bool {
    let id = Id::unique("reveal");
    let asked = ui.data(|data| data.get_temp::<(&'static str, u64)>(id));
    let is_asked = asked
        .is_some_and(|(asked, until)| asked == name && ui.ctx().cumulative_frame_nr() <= until);
    if is_asked {
        ui.data_mut(|data| data.remove::<(&'static str, u64)>(id));
    }
    is_asked
}
