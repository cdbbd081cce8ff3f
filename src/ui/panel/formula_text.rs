//! The formula editor: a window with the text of the scene's formula, which draws while it is typed.

use std::sync::Arc;

use egui::{
    Align2, Button, FontId, Galley, Id, Key, Label, Modifiers, Rect, RichText, ScrollArea, Stroke,
    TextBuffer, TextEdit, TextFormat, Ui,
    text::{CCursor, CCursorRange, LayoutJob},
    vec2,
};

use super::context::Context;
use crate::{
    formula::{
        self, FormulaRef, TextError,
        language::{
            functions::FUNCTIONS,
            tokens::{Completion, TokenKind, completions, tokens},
            tree::Span,
        },
        own,
    },
    ui::{
        settings::MAX_KEPT_FORMULAS,
        theme,
        widgets::{Help as _, caption, window_heading},
    },
};

/// Pause after the last key before a text is drawn, in seconds.
const PAUSE_SECS: f64 = 0.3;
/// Number of completions that are offered.
const COMPLETIONS: usize = 4;
/// Least width of the window, in points: narrower, its texts would be taller than a screen.
const MIN_WIDTH: f32 = 280.0;
/// Least height of the text, in points.
const MIN_TEXT_HEIGHT: f32 = 120.0;
/// Height of what is below the text before it was drawn, in points.
const BELOW_TEXT_HEIGHT: f32 = 90.0;
/// Greatest size of the window, in points.
const WINDOW: [f32; 2] = [560.0, 620.0];
/// Height below the editor that stays free, in points: that of the status line, so that the editor covers the tools above
/// that line whole. As much stays free above an editor of the greatest height.
const ABOVE_STATUS: f32 = 28.0;

/// The editor's state between frames.
#[derive(Clone, Debug, Default)]
struct Draft {
    is_open: bool,
    text: String,
    /// The formula that the text was read from or last made into.
    formula: Option<FormulaRef>,
    /// When the text was changed, while it is not drawn; in seconds.
    changed_at: Option<f64>,
    error: Option<TextError>,
    /// Words that could stand at the cursor.
    offered: Vec<Offer>,
}

/// A word that could stand at the cursor.
#[derive(Clone, Debug)]
struct Offer {
    /// The beginning of the word in the text.
    span: Span,
    word: String,
    help: String,
}

fn draft_id() -> Id {
    Id::unique("formula text")
}

/// The text of a formula, for reading and as a start; none for hybrids.
fn text_of(formula: FormulaRef) -> Option<&'static str> {
    let of_program = || {
        let mut all = formula::texts().chain(formula::step_texts());
        all.find_map(|(id, text)| (id == formula.id()).then_some(text))
    };
    formula.text().or_else(of_program)
}

/// A button that opens the editor.
pub(super) fn button(ui: &mut Ui, cx: &Context<'_>) {
    // A hybrid has no text of its own: its steps have.
    if text_of(cx.scene.fractal.formula()).is_none() {
        return;
    }
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = ui
        .add_sized(size, Button::new("Edit the formula…"))
        .help("Read the formula, change it, or write your own");
    if button.clicked() {
        let mut draft: Draft = ui.data_mut(|data| data.get_temp(draft_id())).unwrap_or_default();
        draft.is_open = !draft.is_open;
        ui.data_mut(|data| data.insert_temp(draft_id(), draft));
    }
}

/// True while the editor is open.
pub fn is_formula_window_open(ctx: &egui::Context) -> bool {
    ctx.data(|data| data.get_temp::<Draft>(draft_id())).is_some_and(|draft| draft.is_open)
}

/// Closes the editor; its text is drawn as after the cross.
pub fn close_formula_window(ctx: &egui::Context) {
    ctx.data_mut(|data| {
        let Some(draft) = data.get_temp::<Draft>(draft_id()) else { return };
        data.insert_temp(draft_id(), Draft { is_open: false, ..draft });
    });
    ctx.request_repaint();
}

/// The editor, while it is open.
pub fn formula_window(ui: &Ui, cx: &mut Context<'_>) {
    let ctx = ui.ctx();
    let Some(mut draft) = ctx.data_mut(|data| data.get_temp::<Draft>(draft_id())) else { return };
    if !draft.is_open {
        if draft.changed_at.is_some() {
            // Closed before the pause after the last key was over.
            draw(cx, &mut draft);
            ctx.data_mut(|data| data.insert_temp(draft_id(), draft));
        }
        return;
    }
    let current = cx.scene.fractal.formula();
    if draft.formula != Some(current) {
        // Another formula was chosen, or a change undone.
        let Some(text) = text_of(current) else { return };
        draft = Draft { text: text.to_owned(), formula: Some(current), ..draft };
        (draft.changed_at, draft.error) = (None, None);
    }
    let screen = ctx.content_rect();
    let size = vec2(WINDOW[0].min(screen.width() - 24.0), WINDOW[1].min(0.72 * screen.height()));
    // Above the status line.
    let room = Rect::from_min_max(screen.min, screen.max - vec2(0.0, ABOVE_STATUS));
    let mut is_open = true;
    // A phone that is turned gets a window of the other shape, and the first one back.
    let id = Id::unique(("formula window", screen.width() > screen.height()));
    let shown = egui::Window::new("Formula")
        .id(id)
        .title_bar(false)
        .constrain_to(room)
        .pivot(Align2::LEFT_BOTTOM)
        .default_pos(room.left_bottom() + vec2(12.0, 0.0))
        .default_size(size)
        .min_width(MIN_WIDTH.min(size.x))
        .max_size(vec2(screen.width() - 24.0, room.height() - ABOVE_STATUS))
        .show(ctx, |ui| {
            is_open = !window_heading(ui, "Formula");
            // What the window is too low for scrolls: it would otherwise grow out of the screen.
            let scroll = ScrollArea::vertical().id_salt("window").auto_shrink(false);
            scroll.show(ui, |ui| contents(ui, cx, &mut draft));
        });
    if let Some(shown) = shown {
        cx.rects.record("formula window", &shown.response);
    }
    draft.is_open = is_open;
    if !is_open {
        // The next frame draws a text whose pause is not over.
        ctx.request_repaint();
    }
    draw_when_typed(ui, cx, &mut draft);
    ctx.data_mut(|data| data.insert_temp(draft_id(), draft));
}

fn contents(ui: &mut Ui, cx: &mut Context<'_>, draft: &mut Draft) {
    // The text has the height that the last frame left: rows for fingers are higher, and the functions may be open.
    let id = ui.scope_id().with("height below the text");
    let below = ui.data(|data| data.get_temp(id)).unwrap_or(BELOW_TEXT_HEIGHT);
    let height = (ui.available_height() - below).max(MIN_TEXT_HEIGHT);
    ScrollArea::vertical().id_salt("text").max_height(height).show(ui, |ui| {
        let id = ui.scope_id().with("editor");
        offer(ui, id, draft);
        // Before the field, which would take the key as a tab.
        let has_focus = ui.memory(|memory| memory.has_focus(id));
        if has_focus
            && let Some(first) = draft.offered.first().cloned()
            && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Tab))
        {
            insert(ui, id, draft, &first);
        }
        let error = draft.error.as_ref().map(|error| error.span);
        let mut layouter = |ui: &Ui, text: &dyn TextBuffer, width: f32| -> Arc<Galley> {
            let job = highlighted(text.as_str(), error, width);
            ui.fonts_mut(|fonts| fonts.layout_job(job))
        };
        let field = TextEdit::multiline(&mut draft.text)
            .id(id)
            .code_editor()
            .desired_width(f32::INFINITY)
            .desired_rows(14)
            .layouter(&mut layouter);
        let response = ui.add(field).accessible_name("Formula text");
        cx.rects.record("formula text", &response);
        if response.changed() {
            draft.changed_at = Some(ui.input(|input| input.time));
        }
        completion_row(ui, id, draft);
    });
    let top = ui.min_rect().bottom();
    message(ui, draft);
    keep_row(ui, cx, draft);
    help(ui);
    let drawn = ui.min_rect().bottom() - top;
    if (drawn - below).abs() > 0.5 {
        ui.data_mut(|data| data.insert_temp(id, drawn));
        ui.ctx().request_repaint();
    }
}

/// Finds the words that could stand at the cursor. They stay while a button with one of them is pressed, which takes the focus.
fn offer(ui: &Ui, id: Id, draft: &mut Draft) {
    if !ui.memory(|memory| memory.has_focus(id)) {
        return;
    }
    let cursor = TextEdit::load_state(ui.ctx(), id).and_then(|state| state.cursor.char_range());
    let found = cursor.filter(CCursorRange::is_empty).and_then(|range| {
        let mut places = draft.text.char_indices();
        let at = places.nth(range.primary.index.0).map_or(draft.text.len(), |(at, _)| at);
        completions(&draft.text, at, COMPLETIONS)
    });
    let (span, found) = found.unwrap_or_default();
    let offer = |one: Completion| Offer { span, word: one.word, help: one.help };
    draft.offered = found.into_iter().map(offer).collect();
}

/// Puts a whole word in the place of its beginning, and the cursor behind.
fn insert(ui: &Ui, id: Id, draft: &mut Draft, offer: &Offer) {
    let Offer { span, word, .. } = offer;
    if draft.text.get(span.start..span.end).is_none() {
        return;
    }
    draft.text.replace_range(span.start..span.end, word);
    let behind = draft.text[..span.start + word.len()].chars().count();
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::one(CCursor::new(behind))));
    state.store(ui.ctx(), id);
    ui.memory_mut(|memory| memory.request_focus(id));
    draft.offered.clear();
    draft.changed_at = Some(ui.input(|input| input.time));
}

/// Buttons with the words that could stand at the cursor.
fn completion_row(ui: &mut Ui, id: Id, draft: &mut Draft) {
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        ui.set_min_height(height);
        for offer in draft.offered.clone() {
            let help = theme::printable(&offer.help);
            let hover = format!("{help}\nTab takes the first.");
            if ui.button(&offer.word).help(hover).clicked() {
                insert(ui, id, draft, &offer);
            }
        }
    });
}

/// What is wrong with the text, or that it is drawn.
fn message(ui: &mut Ui, draft: &Draft) {
    let text = match (&draft.error, draft.changed_at) {
        (Some(error), _) => RichText::new(theme::printable(&error.to_string())).color(theme::ERROR),
        (None, Some(_)) => RichText::new("Typing…").color(theme::TEXT_DIM),
        (None, None) => RichText::new("The picture shows this text.").color(theme::TEXT_DIM),
    };
    ui.add(Label::new(text).wrap());
}

/// A button that keeps the formula in this browser, or forgets it.
fn keep_row(ui: &mut Ui, cx: &mut Context<'_>, draft: &Draft) {
    let Some(text) = draft.formula.and_then(|formula| formula.text()) else { return };
    let kept = &mut cx.settings.formulas;
    let place = kept.iter().position(|other| other == text);
    let (label, hover) = match place {
        None => ("Keep in my formulas", "Lists the formula with the others, in this browser"),
        Some(_) => ("Remove from my formulas", "The scene keeps the formula"),
    };
    let has_room = place.is_some() || kept.len() < MAX_KEPT_FORMULAS;
    let disabled = if has_room {
        "Correct the text first.".to_owned()
    } else {
        format!("A browser keeps {MAX_KEPT_FORMULAS} formulas. Remove one first.")
    };
    let button = ui
        .add_enabled(has_room && draft.error.is_none(), Button::new(label))
        .help(hover)
        .disabled_help(disabled);
    if button.clicked() {
        match place {
            Some(place) => drop(kept.remove(place)),
            None => kept.push(text.to_owned()),
        }
    }
}

/// The functions that a text can call.
fn help(ui: &mut Ui) {
    ui.collapsing("Functions", |ui| {
        ScrollArea::vertical().id_salt("functions").max_height(160.0).show(ui, |ui| {
            for function in FUNCTIONS {
                let arguments: Vec<_> = function.arguments.iter().map(|(name, _)| *name).collect();
                caption(ui, &format!("{}({})", function.name, arguments.join(", ")));
                let help = theme::printable(function.help);
                ui.add(Label::new(RichText::new(help).small()).wrap());
            }
        });
    });
}

/// Draws the text once no key was pressed for a moment. While the text is wrong, the picture stays.
fn draw_when_typed(ui: &Ui, cx: &mut Context<'_>, draft: &mut Draft) {
    let Some(changed_at) = draft.changed_at else { return };
    let left = changed_at + PAUSE_SECS - ui.input(|input| input.time);
    if left > 0.0 {
        ui.ctx().request_repaint_after_secs(left as f32);
        return;
    }
    draw(cx, draft);
}

/// Draws the text, if it is right.
fn draw(cx: &mut Context<'_>, draft: &mut Draft) {
    draft.changed_at = None;
    match own::alone(&draft.text) {
        Ok(formula) => {
            draft.error = None;
            draft.formula = Some(formula);
            if formula != cx.scene.fractal.formula() {
                cx.scene.fractal = own::with_values_of(formula, &cx.scene.fractal);
            }
        }
        Err(error) => draft.error = Some(error),
    }
}

/// The text in the colours of its tokens; the part that is wrong is underlined.
fn highlighted(text: &str, error: Option<Span>, width: f32) -> LayoutJob {
    let mut job = LayoutJob::default();
    job.wrap.max_width = width;
    for (kind, span) in tokens(text) {
        let color = match kind {
            TokenKind::Comment => theme::TEXT_DIM,
            TokenKind::Text => theme::CODE_TEXT,
            TokenKind::Number => theme::CODE_NUMBER,
            TokenKind::Keyword => theme::ACCENT,
            TokenKind::Function | TokenKind::BuiltIn => theme::CODE_FUNCTION,
            TokenKind::Name | TokenKind::Other => theme::TEXT,
        };
        let plain = TextFormat::simple(FontId::monospace(12.0), color);
        let wrong = TextFormat { underline: Stroke::new(2.0, theme::ERROR), ..plain.clone() };
        // Places are of the text that was checked, which may be an older one: they may fall inside a letter.
        let error = error.unwrap_or_default();
        let from = text.floor_char_boundary(error.start.clamp(span.start, span.end));
        let to = text.floor_char_boundary(error.end.clamp(from, span.end));
        for (part, format) in
            [(span.start..from, &plain), (from..to, &wrong), (to..span.end, &plain)]
        {
            if let Some(part) = text.get(part).filter(|part| !part.is_empty()) {
                job.append(part, 0.0, format.clone());
            }
        }
    }
    job
}
