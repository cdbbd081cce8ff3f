//! A button with a small painting, and its name below.

use egui::{
    Align2, Color32, FontId, Painter, Rect, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    accesskit::{Role, Toggled},
};

use crate::ui::theme;

/// Height of the name below the painting, in points.
pub const NAME_HEIGHT: f32 = 17.0;

/// A button in `rect` with `name` below the painting that `paint` makes; screen readers say `title`.
///
/// `is_chosen` marks the swatch of what the scene has.
pub fn swatch(
    ui: &Ui,
    rect: Rect,
    [name, title]: [&str; 2],
    is_chosen: bool,
    paint: impl FnOnce(&Painter, Rect),
) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(title), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_chosen, title));
    let toggled = if is_chosen { Toggled::True } else { Toggled::False };
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_toggled(toggled));
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if ui.is_rect_visible(rect) {
        let (painting, below) = rect.split_top_bottom_at_y(rect.bottom() - NAME_HEIGHT);
        let painter = ui.painter();
        paint(painter, painting);
        let edge = match (response.has_focus(), is_chosen, response.hovered()) {
            (true, ..) => Stroke::new(2.0, Color32::WHITE),
            (_, true, _) => Stroke::new(2.0, theme::ACCENT),
            (.., true) => Stroke::new(1.5, Color32::from_white_alpha(170)),
            _ => Stroke::new(1.0, theme::LINE),
        };
        painter.rect_stroke(painting, 3.0, edge, StrokeKind::Outside);
        let is_lit = response.has_focus() || response.hovered();
        let color = match (is_chosen, is_lit) {
            (true, _) => theme::ACCENT,
            (_, true) => Color32::WHITE,
            _ => theme::TEXT,
        };
        let font = FontId::proportional(12.0);
        let mut job = egui::text::LayoutJob::simple_singleline(name.to_owned(), font, color);
        job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width());
        let galley = painter.layout_job(job);
        let place = Align2::CENTER_BOTTOM.anchor_size(below.center_bottom(), galley.size());
        painter.galley(place.min, galley, color);
    }
    response
}
