//! Hover texts that leave the controls around them in sight.

use egui::{Label, PopupAnchor, Rect, RectAlign, Response, Tooltip};

/// Shows `text` on the left of `row` while `response` is hovered; above it where that has no room.
///
/// egui's own place, below the widget, hides the next row of a panel.
pub fn hover_beside(response: Response, row: Rect, text: &str) -> Response {
    let mut tooltip = Tooltip::for_enabled(&response);
    tooltip.popup = tooltip
        .popup
        .anchor(PopupAnchor::ParentRect(row))
        .align(RectAlign::LEFT)
        .align_alternatives(&[RectAlign::TOP_START, RectAlign::BOTTOM_START]);
    tooltip.show(|ui| ui.add(Label::new(text).wrap()));
    response
}
