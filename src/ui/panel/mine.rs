//! The list of views that a person keeps: to keep the present one, open, rename, remove.

use egui::{Align2, Button, RichText, TextEdit, Ui, vec2};

use super::{card_grid::arrange, context::Context};
use crate::ui::{
    action::Action,
    favourites::MAX_FAVOURITES,
    shortcuts::Command,
    theme,
    widgets::{Help as _, card},
};

/// The button that keeps the view, and a card for each kept one.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    cx.favourites.forget_pictures(ui.ctx());
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = Button::new("Keep this view");
    let keep = ui
        .add_enabled_ui(cx.favourites.has_room(), |ui| ui.add_sized(size, button))
        .inner
        .help("Keeps the scene with a small picture, in this browser alone")
        .disabled_help(format!("There are {MAX_FAVOURITES} views. Remove one first."));
    cx.rects.record("keep view", &keep);
    if keep.clicked() {
        cx.actions.push(Action::KeepFavourite);
    }
    if cx.favourites.list().is_empty() {
        let text = "Views that you keep stand here, and stay in this browser.";
        ui.label(RichText::new(text).color(theme::TEXT_DIM));
        return;
    }
    edit_opened(ui, cx);
    let opened = cx.favourites.opened;
    let mut clicked = None;
    let list = cx.favourites.list();
    arrange(ui, cx.is_sheet, "kept views", list.len(), |ui, index, rect| {
        let kept = &list[index];
        ui.push_id(index, |ui| {
            let card = card(ui, rect, &kept.name, Some(kept.image()), opened == Some(index));
            if card.help("Fly to this view").clicked() {
                clicked = Some(index);
            }
        });
    });
    if let Some(index) = clicked {
        cx.commands.push(Command::Favourite(index));
    }
}

/// The name of the opened view, and the button that removes it.
fn edit_opened(ui: &mut Ui, cx: &mut Context<'_>) {
    let Some(index) = cx.favourites.opened else { return };
    let Some(kept) = cx.favourites.list().get(index) else { return };
    let mut name = kept.name.clone();
    ui.horizontal(|ui| {
        let remove = 84.0;
        let height = ui.spacing().interact_size.y;
        let width = (ui.available_width() - remove - ui.spacing().item_spacing.x).max(60.0);
        let field = TextEdit::singleline(&mut name).align(Align2::LEFT_CENTER);
        let field = ui.add_sized(vec2(width, height), field).help("The view's name");
        if field.changed() {
            cx.favourites.rename(index, &name);
        }
        field.accessible_name("Name of the view");
        let button = ui.add_sized(vec2(remove, height), Button::new("Remove"));
        if button.help("Remove this view from the list").clicked() {
            cx.favourites.remove(index);
        }
    });
}
