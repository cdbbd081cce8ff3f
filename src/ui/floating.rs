//! Buttons and captions over the picture.

use egui::{Align2, Label, Margin, Pos2, Rect, Response, Stroke, StrokeKind, Ui, vec2};

use super::{
    icon::{Icon, icon_button},
    theme,
};

/// Distance between buttons, and to the picture's edges, in points.
pub const GAP: f32 = 10.0;

/// Width and height of a button over the picture, in points.
pub fn button_side(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y.max(34.0)
}

/// An icon button over the picture; its name is for screen readers.
pub fn button(ui: &mut Ui, at: Pos2, icon: Icon, (name, hover): (&str, &str)) -> Response {
    let at = Rect::from_min_size(at, vec2(1.0, 1.0) * button_side(ui));
    ui.painter().rect_filled(at, theme::RADIUS, theme::PANEL.gamma_multiply(0.8));
    ui.put(at, |ui: &mut Ui| icon_button(ui, icon, name, hover))
}

/// A line of text at the lower edge of the picture in `view`, which does not take the pointer.
pub fn caption(ui: &Ui, view: Rect, text: &str) -> Response {
    // In a narrow picture the buttons of the lower left corner would lie under the text.
    let above = if view.width() < 800.0 { button_side(ui) + 2.0 * GAP } else { 14.0 };
    let shown = egui::Area::new(egui::Id::unique("caption"))
        .fixed_pos(view.center_bottom() - vec2(0.0, above))
        .pivot(Align2::CENTER_BOTTOM)
        .constrain_to(view)
        .interactable(false)
        .show(ui.ctx(), |ui| {
            let frame = egui::Frame::new().fill(theme::PANEL.gamma_multiply(0.9)).corner_radius(8);
            frame.inner_margin(Margin::symmetric(12, 6)).show(ui, |ui| {
                ui.set_max_width((view.width() - 48.0).max(80.0));
                ui.add(Label::new(text).selectable(false).wrap());
            });
        });
    shown.response
}

/// Marks a button whose function is on.
pub fn mark(ui: &Ui, button: &Response) {
    let edge = Stroke::new(1.0, theme::ACCENT);
    ui.painter().rect_stroke(button.rect, theme::RADIUS, edge, StrokeKind::Inside);
}

/// A row of buttons in the picture's lower left corner.
pub struct ButtonRow {
    next: Pos2,
}

impl ButtonRow {
    /// An empty row over the picture in `rect`.
    pub fn new(ui: &Ui, rect: Rect) -> Self {
        Self { next: rect.left_bottom() + vec2(GAP, -GAP - button_side(ui)) }
    }

    /// Adds a button on the right of the others.
    pub fn add(&mut self, ui: &mut Ui, icon: Icon, name_and_hover: (&str, &str)) -> Response {
        let button = button(ui, self.next, icon, name_and_hover);
        self.next.x += button_side(ui) + GAP;
        button
    }

    /// The area of the row's buttons, with the gap around them.
    pub fn area(&self, picture: Rect) -> Rect {
        Rect::from_min_max(
            Pos2::new(picture.left(), self.next.y - GAP),
            Pos2::new(self.next.x, picture.bottom()),
        )
    }
}
