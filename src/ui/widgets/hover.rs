//! Hover texts that leave the controls around them in sight.

use egui::{Id, Label, PopupAnchor, Rect, RectAlign, Response, Tooltip, Ui};

/// Tells hover texts where the panel is in this frame.
pub fn set_panel_area(ui: &Ui, area: Rect) {
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique("panel area"), area));
}

/// A hover text beside the panel.
pub trait Help {
    /// Shows `text` while the control is hovered: on the left of the panel; where that has no room, above
    /// the control; outside of the panel below it.
    ///
    /// egui's own place, below the control, hides the next row of a panel.
    fn help(self, text: impl Into<String>) -> Self;
}

impl Help for Response {
    fn help(self, text: impl Into<String>) -> Self {
        let text = text.into();
        self.ctx.accesskit_node_builder(self.id, |node| node.set_description(text.as_str()));
        let panel: Option<Rect> = self.ctx.data(|data| data.get_temp(Id::unique("panel area")));
        let Some(panel) = panel.filter(|panel| panel.contains(self.rect.center())) else {
            return self.on_hover_text(text);
        };
        let row = Rect::from_x_y_ranges(panel.x_range(), self.rect.y_range());
        let mut tooltip = Tooltip::for_enabled(&self);
        tooltip.popup = tooltip
            .popup
            .anchor(PopupAnchor::ParentRect(row))
            .align(RectAlign::LEFT)
            .align_alternatives(&[RectAlign::TOP_START, RectAlign::BOTTOM_START]);
        tooltip.show(|ui| ui.add(Label::new(text).wrap()));
        self
    }
}
