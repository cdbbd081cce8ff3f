//! The gallery that the page's address names: a card for each picture of its list.

use egui::{Image, RichText, Ui};

use super::{card_grid::arrange, context::Context};
use crate::ui::{
    GalleryState,
    action::Action,
    theme,
    widgets::{Help as _, card},
};

/// The names of the cards whose places are recorded.
const RECORDED: [&str; 3] = ["gallery 0", "gallery 1", "gallery 2"];

/// The name of the gallery, and a card for each picture; or why there is none.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>, state: &GalleryState) {
    let note = |ui: &mut Ui, text: &str, color| {
        ui.label(RichText::new(theme::printable(text)).color(color));
    };
    let (address, gallery) = match state {
        GalleryState::Loading => return note(ui, "Reading the gallery…", theme::TEXT_DIM),
        GalleryState::Failed(reason) => return note(ui, reason, theme::ERROR),
        GalleryState::Ready { address, gallery } => (address, gallery),
    };
    if !gallery.name.is_empty() {
        note(ui, &gallery.name, theme::TEXT);
    }
    arrange(ui, cx.is_sheet, "gallery", gallery.pictures.len(), |ui, index, rect| {
        let picture = &gallery.pictures[index];
        let image = Image::from_uri(format!("{address}{}", picture.file));
        ui.push_id(index, |ui| {
            let name = theme::printable(&picture.name);
            let card = card(ui, rect, &name, Some(image), false);
            if let Some(name) = RECORDED.get(index) {
                cx.rects.record(name, &card);
            }
            if card.help("Fly to this picture's scene").clicked() {
                cx.actions.push(Action::OpenGalleryPicture(index));
            }
        });
    });
}
