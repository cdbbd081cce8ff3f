//! Brings a control into sight that was asked for by name.

use egui::{Id, Ui};

/// Asks for the control or section called `name`, which brings itself into sight when it is drawn.
pub fn reveal(ui: &Ui, name: &'static str) {
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique("reveal"), name));
    ui.ctx().request_repaint();
}

/// True once for the control or section that was asked for.
pub fn revealed(ui: &Ui, name: &str) -> bool {
    let id = Id::unique("reveal");
    let is_asked = ui.data(|data| data.get_temp::<&'static str>(id)) == Some(name);
    if is_asked {
        ui.data_mut(|data| data.remove::<&'static str>(id));
    }
    is_asked
}
