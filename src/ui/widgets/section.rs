//! Collapsible sections, captions, and choices between a few options.

use super::hover::Help as _;
use egui::emath::GuiRounding as _;
use egui::{
    Button, IntoAtoms, Response, RichText, Sense, Ui, Vec2, WidgetInfo, accesskit::Role,
    collapsing_header::CollapsingState, pos2, vec2,
};

use crate::ui::{
    icon::{Icon, paint},
    theme,
};

/// A collapsible section: a heading over the full width, and `body` if `open`.
///
/// A click toggles `open`. Returns the heading's response.
pub fn section(
    ui: &mut Ui,
    title: &str,
    hover: &str,
    open: &mut bool,
    body: impl FnOnce(&mut Ui),
) -> Response {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y.max(30.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    if response.clicked() {
        *open = !*open;
    }
    response.widget_info(|| WidgetInfo::labeled(Role::DisclosureTriangle, ui.is_enabled(), title));
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_expanded(*open));
    if ui.is_rect_visible(rect) {
        let lit = response.hovered() || response.has_focus();
        let color = if lit { egui::Color32::WHITE } else { theme::TEXT };
        let painter = ui.painter();
        painter.hline(rect.x_range(), rect.top(), egui::Stroke::new(1.0, theme::LINE));
        let icon = if *open { Icon::ChevronDown } else { Icon::ChevronRight };
        paint(painter, icon, pos2(rect.left() + 7.0, rect.center().y), 12.0, theme::TEXT_DIM);
        let at = pos2(rect.left() + 20.0, rect.center().y);
        painter.text(at, egui::Align2::LEFT_CENTER, title, egui::FontId::proportional(14.0), color);
        if response.has_focus() {
            painter.rect_stroke(
                rect,
                theme::RADIUS,
                egui::Stroke::new(1.0, theme::ACCENT),
                egui::StrokeKind::Inside,
            );
        }
    }
    let mut state =
        CollapsingState::load_with_default_open(ui.ctx(), response.id.with("fold"), *open);
    state.set_open(*open);
    state.show_body_unindented(ui, |ui| {
        body(ui);
        ui.add_space(8.0);
    });
    response.help(hover)
}

/// A small dimmed heading.
pub fn caption(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(text).small().color(theme::TEXT_DIM));
}

/// Maximum number of options in a single row.
const MAX_IN_SINGLE_ROW: usize = 4;
/// Number of options per row if one row is not enough.
const COLUMNS: usize = 3;

/// A caption, and a row of buttons of which one is selected.
///
/// Each option is `(value, name, hover text)`. A button's accessible name is `caption: name`.
/// Returns the union of the buttons' responses, marked as changed if the value changed.
pub fn choice<T: PartialEq + Copy>(
    ui: &mut Ui,
    title: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
) -> Response {
    caption(ui, title);
    let columns = if options.len() > MAX_IN_SINGLE_ROW { COLUMNS } else { options.len().max(1) };
    let rows = options.chunks(columns).map(|row| choice_row(ui, title, value, row, columns));
    rows.flatten()
        .reduce(|all, row| all.union(row))
        .unwrap_or_else(|| ui.allocate_response(Vec2::ZERO, Sense::hover()))
}

/// Space beside the text of a choice's button, in points.
const CHOICE_PADDING: f32 = 4.0;

/// Widths of buttons with these texts that share `total`: equal ones, unless a text is too long for them and all have room,
/// at least `least` each.
///
/// Multiples of egui's unit of layout: egui would round others up, and each row would widen the panel.
fn choice_widths(text_widths: &[f32], total: f32, columns: usize, least: f32) -> Vec<f32> {
    let equal = total / columns as f32;
    let needed: Vec<f32> =
        text_widths.iter().map(|width| (width + 2.0 * CHOICE_PADDING).max(least)).collect();
    let slack = total - needed.iter().sum::<f32>();
    let is_full = needed.len() == columns;
    if is_full && slack >= 0.0 && needed.iter().any(|width| *width > equal) {
        needed.iter().map(|width| (width + slack / columns as f32).floor_ui()).collect()
    } else {
        vec![equal.floor_ui(); needed.len()]
    }
}

/// A button for one of several choices, as wide and high as fingers need it at least.
pub fn choice_button<'a>(ui: &mut Ui, is_chosen: bool, text: impl IntoAtoms<'a>) -> Response {
    ui.add(Button::selectable(is_chosen, text).min_size(ui.spacing().interact_size))
}

/// `count` equal buttons over the full width, in one row if they are wide enough there; `add(ui, index, size)` adds
/// the button `index`.
pub fn button_row(ui: &mut Ui, count: usize, mut add: impl FnMut(&mut Ui, usize, Vec2)) {
    let gap = 4.0;
    let (total, least) = (ui.available_width(), ui.spacing().interact_size.x);
    let most = (((total + gap) / (least + gap)).floor() as usize).max(1);
    let columns = count.div_ceil(count.div_ceil(most).max(1)).max(1);
    let width = (total - gap * (columns as f32 - 1.0)) / columns as f32;
    // Rounded up, the buttons would widen the panel.
    let size = vec2(width.floor_ui(), ui.spacing().interact_size.y);
    for first in (0..count).step_by(columns) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            ui.spacing_mut().button_padding.x = 2.0;
            for index in first..count.min(first + columns) {
                add(ui, index, size);
            }
        });
    }
}

/// One row of a choice; the buttons share the width as [`choice_widths`] says.
fn choice_row<T: PartialEq + Copy>(
    ui: &mut Ui,
    title: &str,
    value: &mut T,
    options: &[(T, &str, &str)],
    columns: usize,
) -> Option<Response> {
    let gap = 4.0;
    let total = ui.available_width() - gap * (columns as f32 - 1.0);
    let text_width = |(_, name, _): &(T, &str, &str)| {
        let text = egui::WidgetText::from(*name);
        let extend = Some(egui::TextWrapMode::Extend);
        text.into_galley(ui, extend, f32::INFINITY, egui::TextStyle::Button).size().x.ceil()
    };
    let text_widths: Vec<f32> = options.iter().map(text_width).collect();
    let widths = choice_widths(&text_widths, total, columns, ui.spacing().interact_size.x);
    let height = ui.spacing().interact_size.y;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        ui.spacing_mut().button_padding.x = CHOICE_PADDING;
        let mut all: Option<Response> = None;
        for ((option, name, hover), width) in options.iter().zip(widths) {
            let button = Button::selectable(*value == *option, *name)
                .min_size(vec2(width, height))
                .truncate()
                .fill(if *value == *option {
                    ui.visuals().selection.bg_fill
                } else {
                    theme::RAISED
                });
            let mut response = ui.add_sized(vec2(width, height), button).help(*hover);
            if response.clicked() && *value != *option {
                *value = *option;
                response.mark_changed();
            }
            let response = response.accessible_name(format!("{title}: {name}"));
            all = Some(match all {
                Some(all) => all.union(response),
                None => response,
            });
        }
        all
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_gets_room_from_short_ones() {
        assert_eq!(choice_widths(&[30.0, 40.0], 200.0, 2, 28.0), [100.0, 100.0]);
        let widths = choice_widths(&[40.0, 80.0, 40.0, 40.0], 280.0, 4, 28.0);
        assert_eq!(widths, [60.0, 100.0, 60.0, 60.0]);
        // Short ones stay wide enough for fingers.
        assert_eq!(choice_widths(&[10.0, 80.0], 144.0, 2, 44.0), [50.0, 94.0]);
        // Without room for all, or with a gap in the row, the texts are cut.
        assert_eq!(choice_widths(&[90.0, 90.0, 20.0], 180.0, 3, 28.0), [60.0; 3]);
        assert_eq!(choice_widths(&[90.0], 180.0, 3, 28.0), [60.0]);
    }

    #[test]
    fn buttons_of_a_choice_are_not_wider_than_their_row() {
        for (texts, total) in [(vec![30.0; 3], 100.0), (vec![30.0, 70.0, 30.0], 200.3)] {
            let widths = choice_widths(&texts, total, texts.len(), 28.0);
            assert!(widths.iter().all(|width| width.round_ui() == *width), "{widths:?}");
            assert!(widths.iter().sum::<f32>() <= total, "{widths:?}");
        }
    }
}
