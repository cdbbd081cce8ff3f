//! The scenes panel: opening scenes, dives, a scene for each formula, mixes, light, one's own, a gallery.

use std::sync::LazyLock;

use egui::{Id, Rect, RichText, Ui};

use super::{card_grid::arrange, context::Context, gallery, mine};
use crate::{
    scene::{
        Scene,
        presets::{self, Preset, PresetList},
    },
    ui::{
        shortcuts::Command,
        status::zoom,
        theme, thumbnail,
        widgets::{Help as _, card, choice_button, scrolled_row},
    },
};

/// Zoom from which on the list of dives is shown first.
const DIVE_ZOOM: f64 = 1e4;

/// The headings of all lists, and a card for each scene of the chosen list.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let lists = presets::lists();
    let id = Id::unique("list of scenes");
    // A user who opens a link to a dive sees the list of dives.
    let dive = usize::from(zoom(&cx.scene.camera) >= DIVE_ZOOM);
    let (mine_list, gallery_list) = (lists.len(), lists.len() + 1);
    // A gallery is what its link is for.
    let opening = if cx.inputs.gallery.is_some() { gallery_list } else { dive };
    let mut chosen = ui.data_mut(|data| *data.get_temp_mut_or(id, opening));
    let gallery = ("Gallery", "The gallery that this page's address names", gallery_list);
    let gallery = cx.inputs.gallery.is_some().then_some(gallery);
    let presets = lists.iter().enumerate().map(|(index, list)| (list.name, list.about, index));
    let mine = ("Mine", "The views that you keep in this browser", mine_list);
    scrolled_row(ui, "lists of scenes", |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 4.0;
        for (name, about, index) in gallery.into_iter().chain(presets).chain([mine]) {
            let text = RichText::new(name).small();
            let response = choice_button(ui, index == chosen, text).help(about);
            cx.rects.record(name, &response);
            if response.clicked() {
                chosen = index;
                ui.data_mut(|data| data.insert_temp(id, chosen));
                response.scroll_to_me(None);
            }
        }
    });
    if let Some(list) = lists.get(chosen) {
        let first = lists.iter().take(chosen).map(|list| list.presets.len()).sum();
        cards(ui, cx, list, first);
    } else if let Some(state) = cx.inputs.gallery.filter(|_| chosen == gallery_list) {
        gallery::show(ui, cx, state);
    } else {
        mine::show(ui, cx);
    }
    if chosen == 1 {
        let drawn = ui
            .checkbox(&mut cx.settings.drawn_to_places, "Zoom finds good places")
            .help("The wheel and two fingers lead to a place near the pointer that stays beautiful at every depth. Off: straight to the pointer.");
        cx.rects.record("drawn to places", &drawn);
    }
}

/// A card for each preset of a list; `first` is the index of its first preset among all.
fn cards(ui: &mut Ui, cx: &mut Context<'_>, list: &PresetList, first: usize) {
    let chosen = chosen(cx.scene);
    arrange(ui, cx.is_sheet, list.name, list.presets.len(), |ui, index, rect| {
        preset_card(ui, cx, rect, &list.presets[index], first + index, chosen);
    });
}

/// The card of the preset that is number `index` of all; `chosen` is the one in view.
fn preset_card(
    ui: &mut Ui,
    cx: &mut Context<'_>,
    rect: Rect,
    preset: &Preset,
    index: usize,
    chosen: Option<usize>,
) {
    let is_chosen = chosen == Some(index);
    let card = card(ui, rect, preset.name, thumbnail::image(preset), is_chosen);
    let about = theme::printable(preset.blurb);
    // The opening scenes have number keys.
    let hover = if index < presets::opening_scenes().len() {
        format!("{about} ({})", index + 1)
    } else {
        about
    };
    let response = card.help(hover);
    if index == 0 {
        cx.rects.record("first scene", &response);
    }
    if response.clicked() {
        cx.commands.push(Command::Preset(index));
    }
}

/// The preset, by its place among all, that the scene still is but for quality and view.
///
/// Of presets that differ by their view only, it is the one whose view the scene has.
fn chosen(scene: &Scene) -> Option<usize> {
    /// The scenes of all presets: dives take a while to read.
    static SCENES: LazyLock<Vec<Scene>> =
        LazyLock::new(|| presets::all().map(|preset| (preset.scene)()).collect());
    let alike = |preset: &Scene| {
        let Scene { quality, camera, .. } = scene;
        preset.fractal == scene.fractal
            && Scene { quality: quality.clone(), camera: camera.clone(), ..preset.clone() }
                == *scene
    };
    let found: Vec<usize> = (0..SCENES.len()).filter(|&index| alike(&SCENES[index])).collect();
    match found.as_slice() {
        [only] => Some(*only),
        several => several.iter().copied().find(|&index| SCENES[index].camera == scene.camera),
    }
}
