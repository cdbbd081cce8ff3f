//! A row of controls that scrolls sideways where it is wider than its place.

use egui::{ScrollArea, Ui};

use super::reveal::reveal_focus;

/// Shows `contents` in a row; what the keyboard reaches scrolls into sight.
pub fn scrolled_row<R>(ui: &mut Ui, id: &str, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let area = ScrollArea::horizontal().id_salt(id).auto_shrink([false, true]);
    area.show(ui, |ui| ui.horizontal(|ui| reveal_focus(ui, contents)).inner).inner
}
