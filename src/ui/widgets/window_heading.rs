//! The heading of a window: its title, and a cross as large as the panels' buttons.

use egui::{Align2, Sense, TextStyle, Ui, vec2};

use crate::ui::{
    icon::{Icon, icon_button, icon_side},
    theme,
};

/// The first row of a window without egui's title bar, whose cross is too small for fingers.
///
/// Returns whether the cross was clicked.
pub fn window_heading(ui: &mut Ui, title: &str) -> bool {
    let side = icon_side(ui);
    ui.horizontal(|ui| {
        let room = (ui.available_width() - side - ui.spacing().item_spacing.x).max(0.0);
        let (rect, _) = ui.allocate_exact_size(vec2(room, side), Sense::hover());
        let font = TextStyle::Heading.resolve(ui.style());
        // Painted: screen readers get the title as the window's name.
        ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, title, font, theme::TEXT);
        icon_button(ui, Icon::Cross, "Close window", "Close this window").clicked()
    })
    .inner
}
