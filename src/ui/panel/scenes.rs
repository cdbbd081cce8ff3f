//! The opening scenes.

use egui::{Button, Ui, vec2};

use super::Context;
use crate::{
    scene::presets,
    ui::{shortcuts::Command, widgets::caption},
};

/// A button for each: two in a row, or four where rows are as high as fingers.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    caption(ui, "Scenes");
    let gap = 6.0;
    let height = ui.spacing().interact_size.y.max(28.0);
    let columns = if height > 40.0 { 4 } else { 2 };
    let size = vec2((ui.available_width() - gap * (columns - 1) as f32) / columns as f32, height);
    ui.spacing_mut().button_padding.x = 2.0;
    egui::Grid::new("scenes").spacing([gap, 5.0]).min_col_width(size.x).show(ui, |ui| {
        for (index, preset) in presets::all().iter().enumerate() {
            let button = ui.add_sized(size, Button::new(preset.name).truncate());
            let response = button.on_hover_text(format!("{} ({})", preset.blurb, index + 1));
            if index == 0 {
                cx.rects.note("first scene", &response);
            }
            if response.clicked() {
                cx.commands.push(Command::Preset(index));
            }
            if index % columns == columns - 1 {
                ui.end_row();
            }
        }
    });
}
