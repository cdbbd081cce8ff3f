//! The opening scenes.

use egui::{Button, Ui, vec2};

use super::Context;
use crate::{
    scene::presets,
    ui::{shortcuts::Command, widgets::caption},
};

/// A button for each, two in a row.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    caption(ui, "Scenes");
    let gap = 6.0;
    let size = vec2((ui.available_width() - gap) / 2.0, ui.spacing().interact_size.y.max(28.0));
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
            if index % 2 == 1 {
                ui.end_row();
            }
        }
    });
}
