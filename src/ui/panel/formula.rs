//! The formula chooser: a button with the formula's name, and below it a list to search.

use egui::{Button, Id, Label, Rect, RichText, ScrollArea, Sense, TextEdit, Ui, Vec2, vec2};

use super::context::Context;
use crate::{
    formula::{self, FormulaRef, own},
    scene::{
        Camera, Fractal, Scene,
        presets::{self, Preset},
    },
    ui::{
        theme, thumbnail,
        widgets::{Help as _, caption, card},
    },
};

/// Columns of the list.
const COLUMNS: usize = 2;
/// Gap between cards, in points.
const GAP: f32 = 6.0;
/// Greatest height of the list, in points.
const MAX_LIST_HEIGHT: f32 = 350.0;
/// What the list remembers between frames.
#[derive(Clone, Debug, Default)]
struct ListState {
    is_open: bool,
    words: String,
}

/// The formula's name as a button, which opens and closes the list.
pub(super) fn choose(ui: &mut Ui, cx: &mut Context<'_>) {
    caption(ui, "Formula");
    let id = Id::unique("formula list");
    let mut state: ListState = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let current = cx.scene.fractal.formula();
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button =
        Button::selectable(state.is_open, format!("{} …", current.name())).fill(theme::RAISED);
    let response = ui
        .add_sized(size, button)
        .help("Choose another formula")
        .accessible_name(format!("Formula: {}", current.name()));
    cx.rects.record("formula", &response);
    if response.clicked() {
        state.is_open = !state.is_open;
    }
    if state.is_open {
        ui.add_space(GAP);
        let all: Vec<_> = kept(cx).into_iter().chain(formula::all()).collect();
        if let Some(chosen) = cards(ui, &mut state.words, &all, Some(current)) {
            if chosen != current {
                change(cx, chosen);
            }
            state.is_open = false;
        }
    }
    let about = RichText::new(cx.scene.fractal.formula().about()).small().color(theme::TEXT_DIM);
    ui.add(Label::new(about).wrap());
    ui.data_mut(|data| data.insert_temp(id, state));
    super::formula_text::button(ui, cx);
}

/// The formulas that are kept in this browser.
pub(super) fn kept(cx: &Context<'_>) -> Vec<FormulaRef> {
    cx.settings.formulas.iter().filter_map(|text| own::alone(text).ok()).collect()
}

/// The search field and a card for each of the formulas that match; returns the formula that was clicked.
pub(super) fn cards(
    ui: &mut Ui,
    words: &mut String,
    all: &[FormulaRef],
    current: Option<FormulaRef>,
) -> Option<FormulaRef> {
    let search = TextEdit::singleline(words).hint_text("Search").desired_width(f32::INFINITY);
    ui.add(search).accessible_name("Search formulas");
    let found: Vec<_> = all.iter().copied().filter(|&formula| matches(formula, words)).collect();
    if found.is_empty() {
        let none = format!("No formula has \"{}\" in its name or description.", words.trim());
        ui.add(Label::new(RichText::new(none).small()).wrap());
        return None;
    }
    let mut clicked = None;
    // Within the panel, which scrolls, a list would shrink to the room that is left.
    let list =
        ScrollArea::vertical().min_scrolled_height(MAX_LIST_HEIGHT).max_height(MAX_LIST_HEIGHT);
    list.id_salt("formulas").show(ui, |ui| {
        let width = ui.available_width();
        let card_width = (width - GAP * (COLUMNS - 1) as f32) / COLUMNS as f32;
        let [width_px, height_px] = thumbnail::SIZE_PX.map(|side| side as f32);
        let size = vec2(card_width, (card_width * height_px / width_px).round());
        let rows = found.len().div_ceil(COLUMNS);
        let height = (size.y + GAP) * rows as f32;
        let (area, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
        for (index, &formula) in found.iter().enumerate() {
            let place = vec2((index % COLUMNS) as f32, (index / COLUMNS) as f32);
            let rect = Rect::from_min_size(area.min + place * (size + Vec2::splat(GAP)), size);
            let picture = preset_of(formula).and_then(thumbnail::image);
            let card = card(ui, rect, formula.name(), picture, Some(formula) == current);
            if card.help(formula.about()).clicked() {
                clicked = Some(formula);
            }
        }
    });
    clicked
}

/// Whether all of `words` are in the formula's name, id or description.
fn matches(formula: FormulaRef, words: &str) -> bool {
    let text = format!("{} {} {}", formula.name(), formula.id(), formula.about()).to_lowercase();
    words.to_lowercase().split_whitespace().all(|word| text.contains(word))
}

/// The scene that shows a formula: it has the formula's name.
fn preset_of(formula: FormulaRef) -> Option<&'static Preset> {
    // A typed formula may have any name.
    if formula.text().is_some() {
        return None;
    }
    presets::all().find(|preset| preset.name == formula.name())
}

/// Shows the formula as its card does, in the light and the colours of the scene; a formula without a picture is seen
/// whole, with its default values.
fn change(cx: &mut Context<'_>, formula: FormulaRef) {
    if let Some(preset) = preset_of(formula) {
        let Scene { fractal, camera, .. } = (preset.scene)();
        cx.scene.fractal = fractal;
        let Camera { lens, stereo, .. } = cx.scene.camera.clone();
        cx.scene.camera = Camera { lens, stereo, ..camera };
        return;
    }
    let fractal = Fractal::new(formula);
    let radius = formula.distance_field(&fractal).bounding_radius();
    cx.scene.fractal = fractal;
    cx.scene.camera = cx.scene.camera.seeing_ball(radius);
}
