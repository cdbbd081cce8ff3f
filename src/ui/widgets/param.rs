//! A row for a parameter of the table: name, slider and number field.
//!
//! In: a [`Param`] and a value. Out: the edited value, which the parameter accepts, and a
//! `Response`.

use egui::{
    Atom, AtomExt as _, Button, DragValue, EventFilter, Key, NumExt as _, Rect, Response, Sense,
    TextEdit, Ui, Vec2, WidgetInfo, WidgetText, accesskit, lerp, pos2,
    text::{CCursor, CCursorRange},
    vec2,
};

use super::scale::{
    at_fraction, clamp_typed, format_value, fraction, is_logarithmic, round_dragged,
};
use super::{hover::Help as _, reveal::revealed};
use crate::{
    scene::param::{Param, Scale, Unit},
    ui::theme,
};

/// Width of the number field at a row's right end, in points.
const VALUE_WIDTH: f32 = 76.0;
/// Space beside a value in its field, in points.
const VALUE_PADDING: f32 = 2.0;
/// Radius of a slider's handle, in points.
const HANDLE_RADIUS: f32 = 7.0;
/// Step of an arrow key for a logarithmic value, as a fraction of the rail.
const LOG_KEY_FRACTION: f64 = 0.01;

/// A row with the parameter's name, a slider, and a number field.
///
/// A double click on the slider or the name resets the value; arrow keys step the value while
/// the slider is focused.
pub fn param_slider(ui: &mut Ui, param: &Param, value: &mut f64) -> Response {
    let height = ui.spacing().interact_size.y;
    let width = ui.available_width();
    let label_width = (width * 0.37).clamp(70.0, 108.0);
    row(ui, param, value, height, |row| {
        let label = Rect::from_min_size(row.min, vec2(label_width, height));
        let number = Rect::from_min_max(pos2(row.right() - VALUE_WIDTH, row.top()), row.max);
        let rail = Rect::from_min_max(
            pos2(label.right(), row.top()),
            pos2(number.left() - 6.0, row.bottom()),
        );
        Parts { label, rail, number }
    })
}

/// As [`param_slider`], with the rail over the whole width below the name and the number.
///
/// A longer rail sets values of a wide range more finely.
pub fn param_slider_wide(ui: &mut Ui, param: &Param, value: &mut f64) -> Response {
    let height = ui.spacing().interact_size.y;
    row(ui, param, value, 2.0 * height, |row| {
        let (top, rail) = row.split_top_bottom_at_y(row.top() + height);
        let (label, number) = top.split_left_right_at_x(top.right() - VALUE_WIDTH);
        Parts { label, rail, number }
    })
}

/// Where the parts of a row are.
struct Parts {
    label: Rect,
    rail: Rect,
    number: Rect,
}

/// A row of the given height, whose parts are where `place` puts them.
fn row(
    ui: &mut Ui,
    param: &Param,
    value: &mut f64,
    height: f32,
    place: impl FnOnce(Rect) -> Parts,
) -> Response {
    let before = *value;
    let row = ui.push_id(param.path, |ui| {
        let (row, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        let Parts { label, rail, number: number_at } = place(row);
        let label = label_ui(ui, label, param.label);
        // Tab and screen readers meet the number above a rail before the rail.
        let is_above = number_at.top() < rail.top();
        let number_ui = |ui: &mut Ui, value: &mut f64| {
            ui.put(number_at, |ui: &mut Ui| number(ui, param, value))
        };
        let above = is_above.then(|| number_ui(ui, value));
        let rail = rail_ui(ui, rail, param, value);
        if revealed(ui, param.path) {
            rail.request_focus();
            rail.scroll_to_me(Some(egui::Align::Center));
        }
        if label.double_clicked() || rail.double_clicked() {
            *value = param.default;
        }
        let number = above.unwrap_or_else(|| number_ui(ui, value));
        let hover = hover_text(param);
        let [label, rail, number] = [label, rail, number].map(|part| part.help(&hover));
        rail.union(label).union(number)
    });
    let mut response = row.inner;
    if *value != before {
        response.mark_changed();
    }
    response
}

/// A row as [`param_slider`], for a whole number.
pub fn param_slider_count(ui: &mut Ui, param: &Param, value: &mut u32) -> Response {
    let mut float = f64::from(*value);
    let response = param_slider(ui, param, &mut float);
    // The value is whole and within the parameter's range, which fits a u32.
    *value = float as u32;
    response
}

/// The value as a button that becomes a text field. A typed value is clamped to the range.
pub fn number(ui: &mut Ui, param: &Param, value: &mut f64) -> Response {
    let id = ui.next_auto_id();
    let size = vec2(ui.available_width().at_most(VALUE_WIDTH), ui.spacing().interact_size.y);
    let name = format!("{} value", param.label);
    if ui.memory(|memory| memory.has_focus(id)) {
        let mut typed = *value;
        let field = DragValue::new(&mut typed)
            .speed(param.step)
            .range(param.min..=param.max)
            .custom_formatter(|v, _| format_value(param, v))
            .update_while_editing(false)
            .clip_text(true)
            .min_size(size);
        let mut response = ui.add(field).accessible_name(name);
        if typed != *value && typed.is_finite() {
            *value = clamp_typed(param, typed);
            response.mark_changed();
        }
        return response;
    }
    let shown = format!("{}{}", format_value(param, *value), param.unit.suffix());
    // A wider button would widen the panel.
    ui.spacing_mut().button_padding.x = VALUE_PADDING;
    // The button must be the next widget, so that the field that replaces it has the same id.
    let text = egui::RichText::new(shown).color(theme::TEXT);
    // Of a button's parts only one is cut off where room is short: here the text, after the gap.
    let button = Button::new((Atom::grow(), text.atom_shrink(true))).frame_when_inactive(false);
    let response = ui.add(button.min_size(size).truncate());
    if response.clicked() {
        let text = format_value(param, *value);
        let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
        let all = CCursorRange::two(CCursor::new(0), CCursor::new(text.chars().count()));
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
        response.request_focus();
    }
    response.accessible_name(name)
}

/// The parameter's hover text: help, unit, range and default.
pub fn hover_text(param: &Param) -> String {
    let unit = match param.unit {
        Unit::None => String::new(),
        Unit::Count => "Whole number. ".to_owned(),
        unit => format!("In {}. ", unit.name()),
    };
    format!(
        "{}\n{unit}{} to {}, default {}. Double click resets.",
        theme::printable(param.help),
        format_value(param, param.min),
        format_value(param, param.max),
        format_value(param, param.default),
    )
}

fn label_ui(ui: &mut Ui, rect: Rect, text: &str) -> Response {
    // The Tab key skips the label: the rail beside it has the name.
    let response = ui.interact(rect, ui.scope_id().with("label"), Sense::CLICK);
    let color = if response.hovered() { theme::TEXT } else { theme::TEXT_DIM };
    let galley = WidgetText::from(text).into_galley(
        ui,
        Some(egui::TextWrapMode::Truncate),
        rect.width() - 6.0,
        egui::TextStyle::Body,
    );
    let at = pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    ui.painter().galley_with_override_text_color(at, galley, color);
    response
}

fn rail_ui(ui: &mut Ui, rect: Rect, param: &Param, value: &mut f64) -> Response {
    let travel = rect.shrink2(vec2(HANDLE_RADIUS + 1.0, 0.0)).x_range();
    let handle_x = |value: f64| lerp(travel.min..=travel.max, fraction(param, value) as f32);

    // On touch screens only the handle drags, so that a finger can scroll the panel on a rail.
    let touch = ui.input(|i| i.has_touch_screen());
    let id = ui.scope_id().with("rail");
    let sense = if touch { Sense::click() } else { Sense::click_and_drag() };
    let mut rail = ui.interact(rect, id, sense);
    let held = if touch {
        let grip = Rect::from_center_size(
            pos2(handle_x(*value), rect.center().y),
            Vec2::splat(rect.height().at_least(44.0)),
        );
        let handle =
            ui.interact(grip.intersect(rect.expand(8.0)), id.with("handle"), Sense::drag());
        let jumped = rail.clicked();
        let held = handle.dragged();
        rail |= handle;
        held || jumped
    } else {
        rail.is_pointer_button_down_on()
    };
    if held {
        follow_pointer(ui, &rail, param, value, handle_x(*value), travel);
    }
    keyboard(ui, &rail, param, value);
    rail.widget_info(|| WidgetInfo::slider(ui.is_enabled(), *value, param.label));
    describe(ui, &rail, param);
    paint_rail(ui, rect, handle_x(*value), &rail);
    rail
}

/// Moves the value with the pointer. A handle grabbed beside its centre does not jump.
fn follow_pointer(
    ui: &Ui,
    rail: &Response,
    param: &Param,
    value: &mut f64,
    handle_x: f32,
    travel: egui::Rangef,
) {
    let Some(pointer) = ui.input(|i| i.pointer.interact_pos()) else {
        return;
    };
    let grab_id = rail.id.with("grab");
    if ui.input(|i| i.pointer.any_pressed()) {
        let offset = handle_x - pointer.x;
        let offset = if offset.abs() <= HANDLE_RADIUS + 3.0 { offset } else { 0.0 };
        ui.data_mut(|data| data.insert_temp(grab_id, (offset, pointer.x)));
    }
    let (offset, pressed_x) = ui.data(|data| data.get_temp(grab_id)).unwrap_or((0.0, f32::NAN));
    if offset != 0.0 && pressed_x == pointer.x {
        return;
    }
    let position = f64::from((pointer.x + offset - travel.min) / travel.span().at_least(1.0));
    *value = round_dragged(param, at_fraction(param, position.clamp(0.0, 1.0)));
}

fn keyboard(ui: &Ui, rail: &Response, param: &Param, value: &mut f64) {
    let mut steps = 0.0;
    if rail.has_focus() {
        ui.memory_mut(|memory| {
            let arrows = EventFilter { horizontal_arrows: true, ..Default::default() };
            memory.set_focus_lock_filter(rail.id, arrows);
        });
        ui.input(|i| {
            let presses = |key| i.num_presses(key) as f64;
            steps += presses(Key::ArrowRight) - presses(Key::ArrowLeft);
            steps += 10.0 * (presses(Key::PageUp) - presses(Key::PageDown));
        });
    }
    ui.input(|i| {
        use accesskit::{Action, ActionData};
        let requests = |action| i.num_accesskit_action_requests(rail.id, action) as f64;
        steps += requests(Action::Increment) - requests(Action::Decrement);
        for request in i.accesskit_action_requests(rail.id, Action::SetValue) {
            if let Some(ActionData::NumericValue(new)) = request.data
                && new.is_finite()
            {
                *value = round_dragged(param, new);
            }
        }
    });
    if steps != 0.0 {
        let moved = if is_logarithmic(param) && param.scale != Scale::Integer {
            at_fraction(param, (fraction(param, *value) + steps * LOG_KEY_FRACTION).clamp(0.0, 1.0))
        } else {
            *value + steps * param.step
        };
        *value = round_dragged(param, moved);
    }
}

fn describe(ui: &Ui, rail: &Response, param: &Param) {
    ui.ctx().accesskit_node_builder(rail.id, |node| {
        node.set_author_id(param.path);
        node.set_min_numeric_value(param.min);
        node.set_max_numeric_value(param.max);
        node.set_numeric_value_step(param.step);
        for action in [
            accesskit::Action::SetValue,
            accesskit::Action::Increment,
            accesskit::Action::Decrement,
        ] {
            node.add_action(action);
        }
    });
}

fn paint_rail(ui: &Ui, rect: Rect, handle_x: f32, rail: &Response) {
    if !ui.is_rect_visible(rect) {
        return;
    }
    let y = rect.center().y;
    let bar = |from: f32, to: f32| Rect::from_min_max(pos2(from, y - 2.0), pos2(to, y + 2.0));
    let painter = ui.painter();
    painter.rect_filled(bar(rect.left(), rect.right()), 2.0, theme::RAISED);
    let enabled = ui.is_enabled();
    let fill = if enabled { theme::ACCENT.gamma_multiply(0.75) } else { theme::RAISED_HOVER };
    painter.rect_filled(bar(rect.left(), handle_x), 2.0, fill);
    let busy = rail.hovered() || rail.is_pointer_button_down_on() || rail.has_focus();
    let color = match (enabled, busy) {
        (false, _) => theme::TEXT_DIM,
        (true, true) => egui::Color32::WHITE,
        (true, false) => theme::TEXT,
    };
    painter.circle_filled(pos2(handle_x, y), HANDLE_RADIUS - 1.0, color);
    if rail.has_focus() {
        painter.circle_stroke(
            pos2(handle_x, y),
            HANDLE_RADIUS + 2.0,
            egui::Stroke::new(1.5, theme::ACCENT),
        );
    }
}
