//! The scenes panel: opening scenes and dives.

use egui::{Button, Id, RichText, Ui, vec2};

use super::context::Context;
use crate::{
    scene::presets::{self, Preset},
    ui::{shortcuts::Command, status::zoom},
};

/// Zoom from which on the list of dives is shown first.
const DIVE_ZOOM: f64 = 1e4;

/// The headings of both lists, and a button for each scene of the chosen list.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let lists = [
        ("Scenes", "Whole fractals and near views", presets::all(), 0),
        ("Dives", "Views at very deep zooms", presets::dives(), presets::all().len()),
    ];
    let id = Id::unique("list of scenes");
    // A user who opens a link to a dive sees the list of dives.
    let opening = usize::from(zoom(&cx.scene.camera) >= DIVE_ZOOM);
    let mut chosen = ui.data_mut(|data| *data.get_temp_mut_or(id, opening));
    ui.horizontal(|ui| {
        for (index, (heading, help, ..)) in lists.iter().enumerate() {
            let text = RichText::new(*heading).small();
            let response = ui.add(Button::selectable(index == chosen, text)).on_hover_text(*help);
            if index == 1 {
                cx.rects.record("dives", &response);
            }
            if response.clicked() {
                chosen = index;
                ui.data_mut(|data| data.insert_temp(id, chosen));
            }
        }
    });
    if let Some(&(heading, _, presets, first)) = lists.get(chosen) {
        buttons(ui, cx, heading, presets, first);
    }
    if chosen == 1 {
        let drawn = ui
            .checkbox(&mut cx.settings.drawn_to_places, "Zoom finds good places")
            .on_hover_text("The wheel and two fingers lead to a place near the pointer that stays beautiful at every depth. Off: straight to the pointer.");
        cx.rects.record("drawn to places", &drawn);
    }
}

/// Buttons of a list, two per row, or four per row on touch screens.
///
/// `first` is the index of the list's first preset among all presets.
fn buttons(
    ui: &mut Ui,
    cx: &mut Context<'_>,
    heading: &str,
    presets: &'static [Preset],
    first: usize,
) {
    let gap = 6.0;
    let height = ui.spacing().interact_size.y.max(28.0);
    let columns = if height > 40.0 { 4 } else { 2 };
    let size = vec2((ui.available_width() - gap * (columns - 1) as f32) / columns as f32, height);
    ui.spacing_mut().button_padding.x = 2.0;
    egui::Grid::new(heading).spacing([gap, 5.0]).min_col_width(size.x).show(ui, |ui| {
        for (index, preset) in presets.iter().enumerate() {
            let button = ui.add_sized(size, Button::new(preset.name).truncate());
            // The first nine presets of the first list have number keys.
            let hover = match first {
                0 if index < 9 => format!("{} ({})", preset.blurb, index + 1),
                _ => preset.blurb.to_owned(),
            };
            let response = button.on_hover_text(hover);
            if index == 0 {
                let name = if first == 0 { "first scene" } else { "first dive" };
                cx.rects.record(name, &response);
            }
            if response.clicked() {
                cx.commands.push(Command::Preset(first + index));
            }
            if index % columns == columns - 1 {
                ui.end_row();
            }
        }
    });
}
