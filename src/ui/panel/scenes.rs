//! The scenes panel: opening scenes, dives, a scene for each formula, mixes.

use std::sync::LazyLock;

use egui::{Button, Id, Rect, RichText, ScrollArea, Sense, Ui, Vec2, vec2};

use super::context::Context;
use crate::{
    scene::{
        Scene,
        presets::{self, Preset, PresetList},
    },
    ui::{shortcuts::Command, status::zoom, theme, thumbnail, widgets::card},
};

/// Zoom from which on the list of dives is shown first.
const DIVE_ZOOM: f64 = 1e4;

/// Gap between cards, in points.
const GAP: f32 = 6.0;
/// Smallest width of a card in a row of more than two, in points.
const MIN_CARD_WIDTH: f32 = 100.0;

/// The headings of all lists, and a card for each scene of the chosen list.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let lists = presets::lists();
    let id = Id::unique("list of scenes");
    // A user who opens a link to a dive sees the list of dives.
    let opening = usize::from(zoom(&cx.scene.camera) >= DIVE_ZOOM);
    let mut chosen = ui.data_mut(|data| *data.get_temp_mut_or(id, opening));
    ui.horizontal_wrapped(|ui| {
        // All lists fit in one row of the panel.
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 5.0;
        for (index, list) in lists.iter().enumerate() {
            let text = RichText::new(list.name).small();
            let button = ui.add(Button::selectable(index == chosen, text));
            let response = button.on_hover_text(list.about);
            cx.rects.record(list.name, &response);
            if response.clicked() {
                chosen = index;
                ui.data_mut(|data| data.insert_temp(id, chosen));
            }
        }
    });
    if let Some(list) = lists.get(chosen) {
        let first = lists.iter().take(chosen).map(|list| list.presets.len()).sum();
        if cx.is_sheet {
            strip(ui, cx, list, first);
        } else {
            cards(ui, cx, list, first);
        }
    }
    if chosen == 1 {
        let drawn = ui
            .checkbox(&mut cx.settings.drawn_to_places, "Zoom finds good places")
            .on_hover_text("The wheel and two fingers lead to a place near the pointer that stays beautiful at every depth. Off: straight to the pointer.");
        cx.rects.record("drawn to places", &drawn);
    }
}

/// A card for each preset of a list, as many per row as fit.
///
/// `first` is the index of the list's first preset among all presets.
fn cards(ui: &mut Ui, cx: &mut Context<'_>, list: &PresetList, first: usize) {
    let presets = list.presets;
    let width = ui.available_width();
    let fitting = ((width + GAP) / (MIN_CARD_WIDTH + GAP)).floor() as usize;
    let columns = fitting.clamp(2, 4);
    let card_width = (width - GAP * (columns - 1) as f32) / columns as f32;
    let [width_px, height_px] = thumbnail::SIZE_PX.map(|side| side as f32);
    let size = vec2(card_width, (card_width * height_px / width_px).round());
    let rows = presets.len().div_ceil(columns);
    let height = (size.y + GAP) * rows as f32 - GAP;
    let (area, _) = ui.allocate_exact_size(vec2(width, height.max(0.0)), Sense::hover());
    let chosen = chosen(cx.scene);
    for (index, preset) in presets.iter().enumerate() {
        let place = vec2((index % columns) as f32, (index / columns) as f32);
        let rect = Rect::from_min_size(area.min + place * (size + Vec2::splat(GAP)), size);
        preset_card(ui, cx, rect, preset, first + index, chosen);
    }
}

/// Height of a card in a sheet's row, in points.
const STRIP_HEIGHT: f32 = 100.0;

/// A row of large cards for the presets of a list, which scrolls sideways.
fn strip(ui: &mut Ui, cx: &mut Context<'_>, list: &PresetList, first: usize) {
    let [width_px, height_px] = thumbnail::SIZE_PX.map(|side| side as f32);
    let size = vec2((STRIP_HEIGHT * width_px / height_px).round(), STRIP_HEIGHT);
    let chosen = chosen(cx.scene);
    ScrollArea::horizontal().id_salt(list.name).show(ui, |ui| {
        let count = list.presets.len() as f32;
        let width = (size.x + GAP) * count - GAP;
        let (area, _) = ui.allocate_exact_size(vec2(width.max(0.0), size.y), Sense::hover());
        for (index, preset) in list.presets.iter().enumerate() {
            let at = area.min + vec2((size.x + GAP) * index as f32, 0.0);
            let rect = Rect::from_min_size(at, size);
            preset_card(ui, cx, rect, preset, first + index, chosen);
        }
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
    // The first nine scenes have number keys.
    let about = theme::printable(preset.blurb);
    let hover = match index {
        0..9 => format!("{about} ({})", index + 1),
        _ => about,
    };
    let response = card.on_hover_text(hover);
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
