//! A hybrid's steps: a list to reorder by dragging, each step with its repeats and parameters.

use egui::{
    Button, CursorIcon, DragValue, Id, Key, Label, Modifiers, Rect, RichText, Sense, Ui, Vec2,
    pos2, vec2,
};

use super::{context::Context, fields::edit_fields, formula::cards};
use crate::{
    formula::{
        FormulaRef, HybridStep, HybridSteps,
        hybrid::{self, HybridError, LOOP_START, REPEATS},
        language::sequence::MAX_STEPS,
    },
    scene::{Fractal, param::Param},
    ui::{
        icon::{Icon, icon_button},
        theme,
        widgets::{Help as _, caption, param_slider_count},
    },
};

/// What the section remembers between frames.
#[derive(Clone, Debug, Default)]
struct State {
    /// The step whose parameters are shown.
    open: Option<usize>,
    /// The step that is dragged.
    dragged: Option<usize>,
    /// Whether the list of formulas for another step is open.
    is_adding: bool,
    words: String,
    /// Why the last change could not be made.
    error: Option<String>,
}

/// A change to the list of steps.
enum Change {
    Move { from: usize, to: usize },
    Remove(usize),
    Add(FormulaRef),
}

/// The steps of a hybrid, or for another fractal a button that makes it one.
pub(super) fn show(ui: &mut Ui, cx: &mut Context<'_>) {
    let id = Id::unique("hybrid");
    let mut state: State = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let mut change = None;
    if let Some(hybrid) = cx.scene.fractal.hybrid() {
        let (count, loop_start) = (hybrid.steps.len(), hybrid.loop_start);
        change = list(ui, cx, &mut state);
        if count > 1 {
            let mut start = loop_start as u32;
            let range = Param { max: count as f64 - 1.0, ..LOOP_START };
            if param_slider_count(ui, &range, &mut start).changed() {
                let steps =
                    HybridSteps { loop_start: start as usize, ..steps_of(&cx.scene.fractal) };
                state.error = replace(cx, steps).err().map(|error| error.to_string());
            }
        }
    }
    change = change.or_else(|| add_button(ui, cx, &mut state));
    if let Some(change) = change {
        state.error = apply(cx, change, &mut state).err().map(|error| error.to_string());
    }
    if let Some(error) = &state.error {
        ui.add(Label::new(RichText::new(error).small().color(theme::ERROR)).wrap());
    }
    ui.data_mut(|data| data.insert_temp(id, state));
}

/// The rows of the steps; returns the change that was asked for.
fn list(ui: &mut Ui, cx: &mut Context<'_>, state: &mut State) -> Option<Change> {
    caption(ui, "Steps, in turn");
    let mut change = None;
    let mut rows: Vec<Rect> = Vec::new();
    let loop_start = cx.scene.fractal.hybrid().map_or(0, |hybrid| hybrid.loop_start);
    let count = cx.scene.fractal.steps_mut().len();
    let mut released = false;
    for place in 0..count {
        let Some(step) = cx.scene.fractal.steps_mut().get_mut(place) else { break };
        ui.push_id(place, |ui| {
            let row = ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                // A wider number would widen the panel.
                ui.spacing_mut().button_padding.x = 2.0;
                let handle = handle(ui, &format!("Move step {}", place + 1));
                if handle.drag_started() {
                    state.dragged = Some(place);
                }
                released |= handle.drag_stopped();
                if handle.has_focus() {
                    let pressed =
                        |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
                    if place > 0 && pressed(Key::ArrowUp) {
                        change = Some(Change::Move { from: place, to: place - 1 });
                    } else if place + 1 < count && pressed(Key::ArrowDown) {
                        change = Some(Change::Move { from: place, to: place + 1 });
                    }
                }
                let is_open = state.open == Some(place);
                let once = if place < loop_start { " (once)" } else { "" };
                let text = format!("{} {}{once}", place + 1, step.formula().name());
                let side = ui.spacing().interact_size.y.max(26.0);
                let width = ui.available_width() - side - 56.0 - 8.0;
                let name = Button::selectable(is_open, text).fill(theme::RAISED).truncate();
                let response =
                    ui.add_sized(vec2(width.max(40.0), side), name).help(step.formula().about());
                if response.clicked() {
                    state.open = (!is_open).then_some(place);
                }
                repeats(ui, place, step);
                let remove = format!("Remove step {}", place + 1);
                if icon_button(ui, Icon::Cross, &remove, "Remove this step").clicked() {
                    change = Some(Change::Remove(place));
                }
            });
            rows.push(row.response.rect);
            if state.open == Some(place) {
                ui.indent("parameters", |ui| edit_fields(ui, step.fields_mut()));
            }
        });
    }
    if let Some(from) = state.dragged {
        let pointer = ui.input(|input| input.pointer.interact_pos());
        let to = pointer.map_or(from, |at| place_at(&rows, at.y));
        if let Some(row) = rows.get(to) {
            let y = if to > from { row.bottom() } else { row.top() };
            let ends = [pos2(row.left(), y), pos2(row.right(), y)];
            ui.painter().line_segment(ends, (2.0, theme::ACCENT));
        }
        // An undo may take away the row that is dragged, and with it the handle.
        if released || from >= count || !ui.input(|input| input.pointer.any_down()) {
            state.dragged = None;
        }
        if released && from < count && to != from {
            change = Some(Change::Move { from, to });
        }
    }
    change
}

/// The row that is nearest to a height.
fn place_at(rows: &[Rect], y: f32) -> usize {
    let distance = |row: &Rect| (row.center().y - y).abs();
    let nearest =
        rows.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
    nearest.map_or(0, |(place, _)| place)
}

/// Six dots to drag a row by; arrow keys move the row while they have the focus.
fn handle(ui: &mut Ui, name: &str) -> egui::Response {
    let size = vec2(theme::target_size(ui, 18.0), ui.spacing().interact_size.y.max(26.0));
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let response = ui.interact(rect, ui.scope_id().with("handle"), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Button, true, name));
    let lit = response.hovered() || response.dragged() || response.has_focus();
    let color = if lit { theme::TEXT } else { theme::TEXT_DIM };
    for column in [-1.0, 1.0] {
        for row in [-1.0, 0.0, 1.0] {
            let dot = rect.center() + Vec2::new(3.0 * column, 5.0 * row);
            ui.painter().circle_filled(dot, 1.5, color);
        }
    }
    if response.clicked() {
        response.request_focus();
    }
    response.on_hover_cursor(CursorIcon::Grab).help("Drag to reorder, or use the arrow keys")
}

fn repeats(ui: &mut Ui, place: usize, step: &mut HybridStep) {
    let range = REPEATS.min as u32..=REPEATS.max as u32;
    // A pasted text may be of any length.
    let value =
        DragValue::new(&mut step.repeats).range(range).prefix("× ").speed(0.1).clip_text(true);
    let size = vec2(56.0, ui.spacing().interact_size.y);
    let response = ui.add_sized(size, value).help(REPEATS.help);
    let name = format!("Repeats of step {}", place + 1);
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// The button that adds a step, and the formulas that a step may have.
fn add_button(ui: &mut Ui, cx: &mut Context<'_>, state: &mut State) -> Option<Change> {
    let is_hybrid = cx.scene.fractal.hybrid().is_some();
    if cx.scene.fractal.hybrid().is_some_and(|hybrid| hybrid.steps.len() >= MAX_STEPS) {
        return None;
    }
    let (text, hover) = if is_hybrid {
        ("Add a step", "Another formula or transform after the last step")
    } else {
        ("Mix with another formula", "Steps of this formula and of others in turn: a hybrid")
    };
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let button = Button::selectable(state.is_adding, text).fill(theme::RAISED);
    let response = ui.add_sized(size, button).help(hover);
    cx.rects.record("add step", &response);
    if response.clicked() {
        state.is_adding = !state.is_adding;
    }
    if !state.is_adding {
        return None;
    }
    ui.add_space(6.0);
    // Transforms first: they are fewer, and no other list has them.
    let kept = super::formula::kept(cx);
    let (mut others, transforms): (Vec<_>, Vec<_>) =
        hybrid::step_formulas().partition(|formula| !hybrid::is_transform(*formula));
    others.sort_by_key(|formula| formula.name());
    let all: Vec<_> = transforms.into_iter().chain(kept).chain(others).collect();
    let chosen = cards(ui, &mut state.words, &all, None)?;
    state.is_adding = false;
    Some(Change::Add(chosen))
}

fn steps_of(fractal: &Fractal) -> HybridSteps {
    fractal.hybrid().cloned().unwrap_or(HybridSteps { steps: Vec::new(), loop_start: 0 })
}

fn apply(cx: &mut Context<'_>, change: Change, state: &mut State) -> Result<(), HybridError> {
    let fractal = &cx.scene.fractal;
    let mut new = steps_of(fractal);
    match change {
        Change::Move { from, to } => {
            let step = new.steps.remove(from);
            new.steps.insert(to, step);
            state.open = None;
        }
        Change::Remove(place) => {
            new.steps.remove(place);
            // The loop still begins with the same step.
            if place < new.loop_start {
                new.loop_start -= 1;
            }
            new.loop_start = new.loop_start.min(new.steps.len().saturating_sub(1));
            state.open = None;
            // One step that can draw alone is no hybrid any more.
            let alone = match &new.steps[..] {
                [] => Some(Fractal::default()),
                [step] => hybrid::alone(fractal, step),
                _ => None,
            };
            if let Some(alone) = alone {
                cx.scene.fractal = alone;
                return Ok(());
            }
        }
        Change::Add(formula) => {
            if new.steps.is_empty() {
                new.steps.push(hybrid::step_of(fractal)?);
            }
            new.steps.push(hybrid::step(formula)?);
            state.open = Some(new.steps.len() - 1);
        }
    }
    replace(cx, new)
}

/// Draws other steps; a hybrid that is new gets a camera that sees all of it.
fn replace(cx: &mut Context<'_>, steps: HybridSteps) -> Result<(), HybridError> {
    let was_hybrid = cx.scene.fractal.hybrid().is_some();
    let fractal = hybrid::with_steps(&cx.scene.fractal, steps)?;
    if !was_hybrid {
        let radius = fractal.formula().distance_field(&fractal).bounding_radius();
        cx.scene.camera = cx.scene.camera.seeing_ball(radius);
    }
    cx.scene.fractal = fractal;
    Ok(())
}
