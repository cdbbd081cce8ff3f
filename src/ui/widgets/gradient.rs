//! The gradient editor: a bar of colours, and a handle for each stop.

use std::iter;

use super::hover::Help as _;
use egui::{
    Color32, Key, Mesh, Painter, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, WidgetInfo,
    WidgetText, accesskit::Role, lerp, pos2, vec2,
};

use crate::{
    scene::{GradientStop, MAX_GRADIENT_STOPS, color::gradient_at},
    ui::theme,
};

/// Height of the bar, in points.
const BAR_HEIGHT: f32 = 26.0;
/// Height of the handles below the bar, in points.
const HANDLE_HEIGHT: f32 = 18.0;
/// Width of a handle's sensitive area, in points.
const HANDLE_WIDTH: f32 = 16.0;
/// Height of a gradient in a list, in points.
const CARD_HEIGHT: f32 = 26.0;
/// Number of colour samples along the bar.
const SAMPLES: usize = 96;

/// Shows the gradient with its stops' handles, and returns the bar's response.
///
/// A click on the bar adds a stop there, a keyboard's click in the widest gap; a drag of a handle moves a stop between its neighbours.
/// `selected` is the index of the selected stop.
pub fn gradient(ui: &mut Ui, stops: &mut Vec<GradientStop>, selected: &mut usize) -> Response {
    // The handles at both ends stay in the window.
    let inset = if theme::has_touch_rows(ui) { 10.0 } else { 7.0 };
    let [bar_height, handle_height] =
        [BAR_HEIGHT, HANDLE_HEIGHT].map(|height| theme::target_size(ui, height));
    let size = vec2(ui.available_width(), bar_height + handle_height);
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let bar =
        Rect::from_min_size(rect.min, vec2(rect.width(), bar_height)).shrink2(vec2(inset, 0.0));
    let mut response = ui.interact(bar, ui.scope_id().with("gradient bar"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, ui.is_enabled(), "Gradient"));

    if response.clicked() {
        let position = match response.interact_pointer_pos() {
            Some(pointer) => position_at(bar, pointer),
            None => widest_gap(stops),
        };
        if let Some(index) = add_stop(stops, position) {
            *selected = index;
            response.mark_changed();
        }
    }
    paint_bar(ui.painter(), bar, stops);
    for index in 0..stops.len() {
        if handle(ui, bar, stops, selected, index) {
            response.mark_changed();
        }
    }
    let full = stops.len() >= MAX_GRADIENT_STOPS;
    let hover = if full {
        "The gradient is full. Remove a stop before you add another."
    } else {
        "Click, or press Enter, to add a stop. Drag the handles below to move stops."
    };
    response.help(hover)
}

/// A button that shows a gradient and its name.
pub fn gradient_card(ui: &mut Ui, name: &str, stops: &[GradientStop], is_chosen: bool) -> Response {
    let size = vec2(ui.available_width(), theme::target_size(ui, CARD_HEIGHT));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_chosen, name));
    if ui.is_rect_visible(rect) {
        let is_lit = response.hovered() || response.has_focus();
        let (label, bar) = rect.split_left_right_at_fraction(0.38);
        let color = if is_chosen {
            theme::ACCENT
        } else if is_lit {
            Color32::WHITE
        } else {
            theme::TEXT
        };
        let galley = WidgetText::from(theme::printable(name)).into_galley(
            ui,
            Some(egui::TextWrapMode::Truncate),
            label.width() - 8.0,
            egui::TextStyle::Body,
        );
        let at = pos2(label.left() + 2.0, label.center().y - galley.size().y / 2.0);
        ui.painter().galley_with_override_text_color(at, galley, color);
        paint_bar(ui.painter(), bar.shrink2(vec2(0.0, 2.0)), stops);
    }
    response
}

/// Adds a stop at `position` with the gradient's colour there; none if the gradient is full.
pub fn add_stop(stops: &mut Vec<GradientStop>, position: f64) -> Option<usize> {
    if stops.len() >= MAX_GRADIENT_STOPS || !position.is_finite() {
        return None;
    }
    let position = position.clamp(0.0, 1.0);
    let color = gradient_at(stops, position).map(|v| v.clamp(0.0, 1.0));
    let index = stops.partition_point(|stop| stop.position <= position);
    stops.insert(index, GradientStop { position, color });
    Some(index)
}

/// The middle of the widest gap between two stops, or between a stop and an end.
fn widest_gap(stops: &[GradientStop]) -> f64 {
    let inner = stops.iter().map(|stop| stop.position);
    let positions: Vec<f64> = iter::once(0.0).chain(inner).chain(iter::once(1.0)).collect();
    let gaps = positions.windows(2).map(|pair| (pair[1] - pair[0], 0.5 * (pair[0] + pair[1])));
    gaps.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.5, |(_, middle)| middle)
}

/// Moves a stop to `position`, clamped to its neighbours' positions.
pub fn move_stop(stops: &mut [GradientStop], index: usize, position: f64) {
    if index >= stops.len() || !position.is_finite() {
        return;
    }
    let low = if index == 0 { 0.0 } else { stops[index - 1].position };
    let high = stops.get(index + 1).map_or(1.0, |stop| stop.position);
    stops[index].position = position.clamp(low, high.max(low));
}

fn position_at(bar: Rect, pointer: Pos2) -> f64 {
    let position = f64::from((pointer.x - bar.left()) / bar.width().max(1.0)).clamp(0.0, 1.0);
    (position * 1000.0).round() / 1000.0
}

fn handle(
    ui: &Ui,
    bar: Rect,
    stops: &mut [GradientStop],
    selected: &mut usize,
    index: usize,
) -> bool {
    let x = lerp(bar.x_range(), stops[index].position as f32);
    let tip = pos2(x, bar.bottom());
    let half = theme::target_size(ui, HANDLE_WIDTH) / 2.0;
    let area = Rect::from_min_max(
        pos2(x - half, bar.bottom() - 2.0),
        pos2(x + half, bar.bottom() + theme::target_size(ui, HANDLE_HEIGHT)),
    );
    let response =
        ui.interact(area, ui.scope_id().with(("gradient stop", index)), Sense::click_and_drag());
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Slider, ui.is_enabled(), format!("Gradient stop {}", index + 1))
    });
    let before = stops[index].position;
    if response.drag_started() || response.clicked() || response.gained_focus() {
        *selected = index;
    }
    if response.dragged()
        && let Some(pointer) = response.interact_pointer_pos()
    {
        move_stop(stops, index, position_at(bar, pointer));
    }
    if response.has_focus() {
        let arrows = egui::EventFilter { horizontal_arrows: true, ..Default::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
        let steps = ui.input(|i| {
            i.num_presses(Key::ArrowRight) as f64 - i.num_presses(Key::ArrowLeft) as f64
        });
        if steps != 0.0 {
            move_stop(stops, index, stops[index].position + 0.01 * steps);
        }
    }
    paint_handle(ui, tip, stops[index].color, *selected == index, response.hovered());
    response.help("Drag to move this stop. Edit its colour and position below.");
    stops[index].position != before
}

fn paint_handle(ui: &Ui, tip: Pos2, linear: [f32; 3], selected: bool, hovered: bool) {
    let outline = if selected {
        theme::ACCENT
    } else if hovered {
        Color32::WHITE
    } else {
        theme::TEXT_DIM
    };
    let corner = |x: f32, y: f32| tip + vec2(x, y);
    let outline_points = vec![
        corner(0.0, 1.0),
        corner(5.5, 6.0),
        corner(5.5, 15.0),
        corner(-5.5, 15.0),
        corner(-5.5, 6.0),
    ];
    let stroke = Stroke::new(if selected { 2.0 } else { 1.0 }, outline);
    ui.painter().add(Shape::convex_polygon(outline_points, theme::display_color(linear), stroke));
}

/// Paints a gradient from left to right.
pub fn paint_bar(painter: &Painter, bar: Rect, stops: &[GradientStop]) {
    let mut mesh = Mesh::default();
    for i in 0..=SAMPLES {
        let t = i as f32 / SAMPLES as f32;
        // The gradient wraps at 1, so the last sample is just below 1.
        let color = theme::display_color(gradient_at(stops, f64::from(t.min(0.9999))));
        let x = lerp(bar.x_range(), t);
        mesh.colored_vertex(pos2(x, bar.top()), color);
        mesh.colored_vertex(pos2(x, bar.bottom()), color);
        if i > 0 {
            let k = 2 * i as u32;
            mesh.add_triangle(k - 2, k - 1, k);
            mesh.add_triangle(k - 1, k + 1, k);
        }
    }
    painter.add(Shape::mesh(mesh));
    painter.rect_stroke(bar, 3.0, Stroke::new(1.0, theme::LINE), egui::StrokeKind::Outside);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stops(positions: &[f64]) -> Vec<GradientStop> {
        positions
            .iter()
            .map(|&position| GradientStop { position, color: [position as f32, 0.5, 0.25] })
            .collect()
    }

    fn sorted(stops: &[GradientStop]) -> bool {
        stops.is_sorted_by(|a, b| a.position <= b.position)
    }

    #[test]
    fn a_new_stop_is_sorted_and_keeps_the_colours() {
        let mut gradient = stops(&[0.0, 0.5, 1.0]);
        let before = gradient_at(&gradient, 0.25);
        assert_eq!(add_stop(&mut gradient, 0.25), Some(1));
        assert!(sorted(&gradient));
        assert_eq!(gradient[1].color, before);
    }

    #[test]
    fn a_full_gradient_rejects_new_stops() {
        let mut gradient = stops(&[0.5; MAX_GRADIENT_STOPS]);
        assert_eq!(add_stop(&mut gradient, 0.7), None);
        assert_eq!(gradient.len(), MAX_GRADIENT_STOPS);
    }

    #[test]
    fn a_stop_stays_between_its_neighbours() {
        let mut gradient = stops(&[0.1, 0.4, 0.9]);
        move_stop(&mut gradient, 1, 5.0);
        assert_eq!(gradient[1].position, 0.9);
        move_stop(&mut gradient, 1, -5.0);
        assert_eq!(gradient[1].position, 0.1);
        move_stop(&mut gradient, 0, -1.0);
        assert_eq!(gradient[0].position, 0.0);
        move_stop(&mut gradient, 2, 7.0);
        assert_eq!(gradient[2].position, 1.0);
        move_stop(&mut gradient, 9, 0.5);
        move_stop(&mut gradient, 1, f64::NAN);
        assert!(sorted(&gradient));
    }
}
